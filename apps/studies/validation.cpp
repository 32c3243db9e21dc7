#include "apps/studies/validation.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/json_file.hpp"
#include "apps/archive/provenance.hpp"
#include "apps/archive/run_folder.hpp"
#include "apps/archive/setting.hpp"
#include "apps/figures/figures.hpp"
#include "apps/measures/fault_history.hpp"
#include "apps/model/effects.hpp"
#include "apps/run/batch.hpp"
#include "apps/studies/plan_file.hpp"
#include "apps/studies/validation_plan.hpp"
#include "apps/studies/validation_report.hpp"
#include "apps/studies/validation_store.hpp"
#include "apps/support/error.hpp"
#include "apps/support/file.hpp"
#include "apps/support/log.hpp"
#include "apps/support/resources.hpp"
#include "apps/support/version.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace listric {

using namespace archive;
using namespace dem;

namespace {

namespace fs = std::filesystem;

/// Facts from the summary of a finished run; both empty if there is none.
struct FinishedRun {
    std::string hash;
    std::string made_by; ///< version and commit of Listric
};

/// Throws UsageError if the folder has a run of another accuracy or seed.
FinishedRun finished_run(const fs::path& folder, const std::string& accuracy, int seed) {
    const JsonObject json = object_in(folder / "summary.json");
    if (!is_true_at(json, "finished"))
        return {};
    const std::string has = text_at(json, "accuracy");
    const double has_seed = number_at(json, "seed").value_or(-1.0);
    if (has != accuracy || has_seed != seed)
        throw UsageError(fmt::format("{}: a run at {} with seed {}, but {} with seed {} is wanted; "
                                     "--runs may name another folder",
                                     folder.string(), has, has_seed, accuracy, seed));
    const JsonObject from = object_at(json, "provenance");
    const std::string commit = text_at(from, "commit");
    return {text_at(json, "state_hash"),
            text_at(from, "version") + (commit.empty() ? "" : "+" + commit)};
}

fs::path document_of(const ValidationRequest& request, const fs::path& runs) {
    return request.output.empty() ? runs / "validation.md" : request.output;
}

ValidationPlan plan_of(const ValidationRequest& request) {
    return load_validation_plan(request.plan.empty() ? resource_folder() / "studies/validation.toml"
                                                     : request.plan);
}

void check_accuracy(const std::string& accuracy) {
    std::vector<std::string_view> levels;
    for (const AccuracyLevel& level : accuracy_levels())
        levels.push_back(level.name);
    if (std::ranges::find(levels, accuracy) == levels.end())
        throw UsageError(
            fmt::format("--accuracy {}: there are {}", accuracy, fmt::join(levels, ", ")));
}

std::vector<ValidationExperiment> chosen(const ValidationPlan& plan,
                                         const std::optional<std::string>& only) {
    std::vector<ValidationExperiment> result;
    std::vector<std::string_view> names;
    for (const ValidationExperiment& x : plan.experiments) {
        names.push_back(x.name);
        if (!only || *only == x.name)
            result.push_back(x);
    }
    if (result.empty())
        throw UsageError(
            fmt::format("--only {}: there are {}", only.value_or(""), fmt::join(names, ", ")));
    return result;
}

/// Drives runs, measures and pictures; what they say is validation_report's.
class Validation {
public:
    Validation(const ValidationRequest& request, const ValidationPlan& plan)
        : request_(request),
          runs_(request.runs.empty() ? fs::path("out/validation-" + request.accuracy)
                                     : request.runs),
          document_(document_of(request, runs_)), findings_{plan,
                                                            request.plan.empty()
                                                                ? "apps/studies/validation.toml"
                                                                : request.plan.string(),
                                                            chosen(plan, request.only),
                                                            store_,
                                                            {},
                                                            request.accuracy,
                                                            request.first_seed,
                                                            request.seeds,
                                                            document_.parent_path() /
                                                                document_.stem()} {
        fs::create_directories(findings_.beside);
        try {
            store_ = read_store(findings_.beside / "measures.csv");
        } catch (const StorageError&) {
            if (!request.remeasure)
                throw;
        }
    }

    void carry_out() {
        std::set<std::string> names;
        for (const ValidationExperiment& x : findings_.experiments)
            names.insert(x.runs.begin(), x.runs.end());
        if (!request_.without_runs)
            make_missing(names);
        for (const std::string& name : names)
            measure_runs(findings_.plan.run(name));
        save_measures();
        for (const ValidationExperiment& x : findings_.experiments)
            for (const ValidationPicture& picture : x.pictures)
                draw(picture);
        write_text(document_, validation_document(findings_));
        log_.say(document_.string());
    }

private:
    void save_measures() const { write_store(findings_.beside / "measures.csv", store_); }
    const std::string& accuracy_of(const ValidationRun& run) const {
        return run.accuracy.empty() ? request_.accuracy : run.accuracy;
    }
    fs::path folder_of(const ValidationRun& run, int seed) const {
        return runs_ / run_name(run.name, seed);
    }
    FinishedRun finished(const ValidationRun& run, int seed) const {
        return finished_run(folder_of(run, seed), accuracy_of(run), seed);
    }

    Scene scene_of(const ValidationRun& run, int seed) const {
        SceneRequest scene;
        scene.scene = run.scene;
        scene.set = run.set;
        scene.without = run.without;
        scene.accuracy = accuracy_of(run);
        scene.seed = seed;
        return load_scene(scene);
    }

    /// Refuses a finished run that was made by another plan. A scene that this program cannot read
    /// any more says nothing.
    void check_scene_of(const ValidationRun& run, int seed) const {
        const fs::path file = folder_of(run, seed) / "scene.toml";
        Scene then;
        try {
            then = load_scene({.scene = file.string(), .is_record = true});
        } catch (const SceneError&) {
            return;
        }
        Scene now = scene_of(run, seed);
        then.description = now.description;
        if (scene_hash(then) != scene_hash(now))
            throw UsageError(fmt::format("{}: a run with other parameters than the plan has; "
                                         "--runs may name another folder",
                                         file.string()));
    }

    /// Makes the runs that are not there.
    void make_missing(const std::set<std::string>& names) {
        std::size_t all = 0;
        for (const std::string& name : names)
            all += findings_.seeds_of(findings_.plan.run(name)).size();
        if (all > static_cast<std::size_t>(most_runs))
            throw UsageError(fmt::format("--seeds {}: the plan needs {} runs, allowed: at most {}",
                                         request_.seeds, all, most_runs));
        std::vector<BatchRun> runs;
        for (const std::string& name : names) {
            const ValidationRun& run = findings_.plan.run(name);
            for (int seed : findings_.seeds_of(run)) {
                request_.stop.check();
                if (!finished(run, seed).hash.empty())
                    continue;
                RunOptions options;
                options.output = folder_of(run, seed);
                options.threads = request_.threads;
                options.quiet = request_.quiet || request_.jobs > 1;
                options.report = false;
                options.stop = request_.stop;
                runs.push_back({run_name(run.name, seed), scene_of(run, seed), std::move(options)});
            }
        }
        const std::vector<BatchEnding> endings =
            make_runs(runs, request_.jobs, log_, request_.stop);
        for (std::size_t k = 0; k < runs.size(); ++k)
            require_finished(runs[k], endings[k]);
    }

    /// The runs that are there, by seed.
    void measure_runs(const ValidationRun& run) {
        bool measured = false;
        for (int seed : findings_.seeds_of(run)) {
            const auto [found, made_by] = finished(run, seed);
            const std::string& hash = found; // clang 14 captures no structured binding
            if (hash.empty())
                continue;
            check_scene_of(run, seed);
            findings_.finished.insert(run_name(run.name, seed));
            const bool anew = request_.remeasure && !renewed_.contains(run.name);
            const bool known = !anew && std::ranges::all_of(run.at, [&](double at) {
                const auto m = store_.find({run.name, seed, at});
                return m != store_.end() && m->second.hash == hash;
            });
            if (known)
                continue;
            request_.stop.check();
            log_.say(fmt::format("measuring {}", folder_of(run, seed).string()));
            for (auto& [at, numbers] : examine_run(folder_of(run, seed), run.at))
                store_[{run.name, seed, at}] = {
                    hash, made_by, std::string(version), {numbers.begin(), numbers.end()}};
            save_measures(); // keeps the measures, whatever comes next
            measured = true;
        }
        if (measured)
            renewed_.insert(run.name);
    }

    /// A state on a picture.
    struct Frame {
        std::string run;
        int seed;
        double at; ///< extension, m
    };

    /// The states of a picture that are there; none if those of a row are missing, since half of a
    /// comparison shows nothing.
    std::vector<Frame> frames_of(const ValidationPicture& picture) const {
        std::vector<Frame> frames;
        for (const auto& row : picture.rows) {
            const ValidationRun& run = findings_.plan.run(row.run);
            std::vector<int> seeds = findings_.seeds_of(run);
            if (row.seeds > 0 && std::ssize(seeds) > row.seeds)
                seeds.resize(static_cast<std::size_t>(row.seeds));
            const std::size_t before = frames.size();
            for (int seed : seeds)
                if (!finished(run, seed).hash.empty())
                    frames.push_back({row.run, seed, row.at});
            if (frames.size() == before)
                return {};
        }
        return frames;
    }

    /// Draws a picture that is not there or has a run that was measured in this call.
    void draw(const ValidationPicture& picture) {
        const fs::path file = findings_.beside / (picture.name + ".png");
        const std::vector<Frame> frames = frames_of(picture);
        const bool renewed =
            !fs::exists(file) || std::ranges::any_of(picture.rows, [&](const auto& row) {
                return renewed_.contains(row.run);
            });
        if (frames.empty() || !renewed)
            return;
        request_.stop.check();
        log_.say(fmt::format("drawing {}", file.string()));
        const TemporaryFolder place(findings_.beside); // a picture of that name may be somebody's
        FigureFrames figure(place.path);
        for (const Frame& frame : frames) {
            RunFolder folder(folder_of(findings_.plan.run(frame.run), frame.seed));
            const fs::path path =
                *std::ranges::min_element(folder.snapshots, {}, [&](const fs::path& snapshot) {
                    return std::abs(snapshot_extension(snapshot) - frame.at);
                });
            const Moment moment = folder.read(path);
            folder.scene.description =
                fmt::format("{}, seed {}, {}", frame.run, frame.seed, extension_text(frame.at));
            figure.add({folder.scene, folder.parts, moment.state, moment.events},
                       report_faults(make_setting(folder.scene, folder.parts), folder.parts.base,
                                     moment.state, RunHistory(folder)));
        }
        figure.draw("gallery");
        fs::rename(place.path / "gallery.png", file);
    }

    const ValidationRequest& request_;
    fs::path runs_, document_;
    MeasureStore store_;
    ValidationFindings findings_;
    std::set<std::string> renewed_; ///< runs that were measured in this call
    Log log_{request_.quiet};
};

} // namespace

void run_validation(const ValidationRequest& request) {
    const ValidationPlan plan = plan_of(request);
    check_accuracy(request.accuracy);
    Validation(request, plan).carry_out();
}

} // namespace listric
