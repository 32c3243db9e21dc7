#include "apps/studies/validation/validation.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/output_folder.hpp"
#include "apps/archive/folder/provenance.hpp"
#include "apps/model/effects.hpp"
#include "apps/run/batch.hpp"
#include "apps/studies/pictured_states.hpp"
#include "apps/studies/plan_file.hpp"
#include "apps/studies/validation/validation_plan.hpp"
#include "apps/studies/validation/validation_report.hpp"
#include "apps/studies/validation/validation_store.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/python.hpp"
#include "apps/support/machine/resources.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace listric {

using namespace archive;
using namespace dem;

namespace {

namespace fs = std::filesystem;

/// Facts from the summary of a finished run, measured by this program; without state hash: there is
/// none. Throws UsageError if the folder has a run of another accuracy or seed.
Origin finished_run(const fs::path& folder, const std::string& accuracy, int seed) {
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
    return {text_at(json, "state_hash"), text_at(from, "scene_hash"),
            text_at(from, "version") + (commit.empty() ? "" : "+" + commit), std::string(version),
            std::string(measures_hash)};
}

ValidationPlan plan_of(const ValidationRequest& request) {
    return load_validation_plan(validation_plans.find(request.plan));
}

void check_accuracy(const std::string& accuracy) {
    std::vector<std::string_view> levels;
    for (const AccuracyLevel& level : accuracy_levels())
        levels.push_back(level.name);
    if (std::ranges::find(levels, accuracy) == levels.end())
        throw UsageError(
            fmt::format("--accuracy {}: there are {}", accuracy, fmt::join(levels, ", ")));
}

/// Names of the runs of the experiments that a call asks for. Throws UsageError.
std::set<std::string> chosen_runs(const ValidationPlan& plan,
                                  const std::vector<std::string>& only) {
    std::set<std::string> runs;
    std::vector<std::string_view> names;
    for (const ValidationExperiment& x : plan.experiments) {
        names.push_back(x.name);
        if (only.empty() || std::ranges::find(only, x.name) != only.end())
            runs.insert(x.runs.begin(), x.runs.end());
    }
    for (const std::string& name : only)
        if (std::ranges::find(names, name) == names.end())
            throw UsageError(fmt::format("--only {}: there are {}", name, fmt::join(names, ", ")));
    return runs;
}

/// Seeds of this call: those asked for, so many or all of the plan's, or, where it has none, from
/// 1 on. Throws UsageError.
std::vector<int> seeds_of_call(const ValidationRequest& request, const ValidationPlan& plan) {
    if (!request.seeds.empty())
        return request.seeds;
    const auto number = static_cast<std::size_t>(request.number);
    std::vector<int> seeds = plan.seeds;
    if (seeds.empty()) {
        seeds.resize(number > 0 ? number : 5);
        std::iota(seeds.begin(), seeds.end(), 1);
    }
    if (number > seeds.size())
        throw UsageError(fmt::format("--seeds {}: the plan has {} seeds; list others, such as "
                                     "71-75, or give --first-seed",
                                     number, seeds.size()));
    if (number > 0)
        seeds.resize(number);
    return seeds;
}

/// Seeds of the document: the plan's, to which a call may add some of; else those of the call.
std::vector<int> seeds_of_document(const ValidationRequest& request, const ValidationPlan& plan) {
    const std::vector<int> asked = seeds_of_call(request, plan);
    return std::ranges::includes(plan.seeds, asked) ? plan.seeds : asked;
}

/// A plan's name where it is on the shelf; one of the user's own goes where the shipped one does.
std::string plan_stem(const ValidationRequest& request) {
    return is_path(request.plan) ? "validation" : request.plan;
}

/// A plan's file, for people.
std::string plan_name(const ValidationRequest& request) {
    return is_path(request.plan) ? request.plan : "apps/studies/" + request.plan + ".toml";
}

/// Drives runs, measures and pictures; what they say is validation_report's.
class Validation {
public:
    Validation(const ValidationRequest& request, const ValidationPlan& plan)
        : request_(request),
          runs_(request.runs.empty()
                    ? fs::path(fmt::format("out/{}-{}", plan_stem(request), request.accuracy))
                    : request.runs),
          document_(request.output.empty() ? runs_ / (plan_stem(request) + ".md") : request.output),
          names_(chosen_runs(plan, request.only)),
          seeds_(seeds_of_call(request, plan)), findings_{.plan = plan,
                                                          .plan_name = plan_name(request),
                                                          .store = store_,
                                                          .accuracy = request.accuracy,
                                                          .seeds = seeds_of_document(request, plan),
                                                          .beside = document_.parent_path() /
                                                                    document_.stem()} {
        require_own_files();
        make_folder(findings_.beside);
        lock_.emplace(findings_.beside);
        try {
            store_ = read_store(findings_.beside / "measures.csv");
        } catch (const StorageError&) {
            if (!request.remeasure)
                throw;
        }
    }

    void carry_out() {
        check_record();
        if (!request_.without_runs)
            make_missing();
        for (const std::string& name : names_)
            measure_runs(findings_.plan.run(name));
        save_measures();
        choose_experiments();
        for (const ValidationExperiment& x : findings_.experiments)
            for (const ValidationPicture& picture : x.pictures)
                draw(picture);
        write_text(findings_.beside / "verdicts.json", validation_chart(findings_));
        draw_or_warn("verdicts.py", {fs::absolute(findings_.beside).string()});
        write_text(document_, validation_document(findings_));
        log_.say(document_.string());
        if (failed_)
            require_finished(failed_->first, failed_->second);
    }

private:
    /// Refuses to write over the plan, and over what no validation has made. Pictures have no mark:
    /// they are a validation's where its record is.
    void require_own_files() const {
        const fs::path& beside = findings_.beside;
        std::vector<OwnFile> written{{document_, "Made by `listric validate`"},
                                     {beside / "verdicts.json", "\"experiments\""},
                                     {beside / "verdicts.png", "Listric"}};
        if (!request_.remeasure) // else what is damaged may be anything
            written.push_back({beside / "measures.csv", "run,seed,at_m"});
        if (!fs::exists(beside / "measures.csv"))
            for (const ValidationExperiment& x : findings_.plan.experiments)
                for (const ValidationPicture& picture : x.pictures)
                    written.push_back({beside / (picture.name + ".png"), "Listric"});
        const fs::path read[]{validation_plans.find(request_.plan)};
        require_own(written, read);
    }

    void save_measures() const { write_store(findings_.beside / "measures.csv", store_); }
    const std::string& accuracy_of(const ValidationRun& run) const {
        return run.accuracy.empty() ? request_.accuracy : run.accuracy;
    }
    fs::path folder_of(const ValidationRun& run, int seed) const {
        return runs_ / run_name(run.name, seed);
    }
    Origin finished(const ValidationRun& run, int seed) const {
        return finished_run(folder_of(run, seed), accuracy_of(run), seed);
    }

    /// Seeds of a run that this call is about.
    std::vector<int> asked_of(const ValidationRun& run) const {
        std::vector<int> seeds;
        std::ranges::copy_if(findings_.seeds_of(run), std::back_inserter(seeds), [&](int seed) {
            return std::ranges::find(seeds_, seed) != seeds_.end();
        });
        return seeds;
    }

    /// Experiments of the document: those that are recorded, in this call or before.
    void choose_experiments() {
        for (const ValidationExperiment& x : findings_.plan.experiments) {
            const ValidationRun& first = findings_.plan.run(x.runs.front());
            if (std::ranges::any_of(findings_.seeds_of(first),
                                    [&](int seed) { return findings_.is_recorded(first, seed); }))
                findings_.experiments.push_back(x);
            else
                findings_.missing.push_back(x.name);
        }
    }

    /// Whether this call measures a run, if it finds or makes it.
    bool is_to_be_measured(const ValidationRun& run, int seed) const {
        const bool recorded = findings_.is_recorded(run, seed);
        if (recorded && !request_.remeasure)
            return false;
        return (!recorded && !request_.without_runs) || !finished(run, seed).state_hash.empty();
    }

    /// Refuses a record whose runs have other parameters than the plan's, and to add to one whose
    /// measures have other definitions than this program's, before any run is made. Another version
    /// may write equal parameters otherwise: a record that it made can be shown, not added to.
    void check_record() {
        std::set<std::pair<std::string, int>> anew;
        for (const std::string& name : names_) {
            const ValidationRun& run = findings_.plan.run(name);
            for (int seed : asked_of(run))
                if (is_to_be_measured(run, seed))
                    anew.emplace(name, seed);
        }
        const auto refuse = [&](const MeasuredPlace& place, const std::string& what) {
            throw UsageError(fmt::format(
                "{}: {} {}; another --output begins another record, --remeasure measures runs that "
                "are still there again, --mixed takes it all the same",
                (findings_.beside / "measures.csv").string(), run_name(place.run, place.seed),
                what));
        };
        for (const auto& [place, m] : store_) {
            if (anew.contains({place.run, place.seed}))
                continue;
            if (!request_.mixed && !anew.empty() && m.from.measures_hash != measures_hash)
                refuse(place, fmt::format("was measured by other definitions ({} by Listric {}) "
                                          "than this program's ({})",
                                          m.from.measures_hash, m.from.measured_by, measures_hash));
            const auto run =
                std::ranges::find(findings_.plan.runs, place.run, &ValidationRun::name);
            if (run == findings_.plan.runs.end() || m.from.scene_hash.empty())
                continue;
            std::string& planned = planned_scenes_[{place.run, place.seed}];
            if (planned.empty())
                planned = fmt::format("{:016x}", scene_hash(scene_of(*run, place.seed)));
            if (m.from.scene_hash == planned)
                continue;
            const bool is_own = m.from.made_by == version;
            if (!request_.mixed && (is_own || !anew.empty()))
                refuse(place, fmt::format("was run with other parameters (scene {}) than the "
                                          "plan has at accuracy {}",
                                          m.from.scene_hash, accuracy_of(*run)));
            (is_own ? findings_.with_other_parameters : findings_.uncompared)
                .insert(run_name(place.run, place.seed));
        }
    }

    Scene scene_of(const ValidationRun& run, int seed) const {
        return load_scene({.scene = run.scene,
                           .set = run.set,
                           .without = run.without,
                           .accuracy = accuracy_of(run),
                           .seed = seed});
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

    /// Makes the runs that are neither recorded nor there. What failed keeps no other run from
    /// being measured.
    void make_missing() {
        std::size_t all = 0;
        for (const std::string& name : names_)
            all += asked_of(findings_.plan.run(name)).size();
        if (all > static_cast<std::size_t>(most_runs))
            throw UsageError(fmt::format("--seeds: the plan needs {} runs with {} seeds, allowed: "
                                         "at most {}",
                                         all, seeds_.size(), most_runs));
        std::vector<BatchRun> runs;
        for (const std::string& name : names_) {
            const ValidationRun& run = findings_.plan.run(name);
            for (int seed : asked_of(run)) {
                request_.stop.check();
                if (!finished(run, seed).state_hash.empty() || findings_.is_recorded(run, seed))
                    continue;
                runs.push_back({run_name(run.name, seed), scene_of(run, seed),
                                request_.options_of_run(folder_of(run, seed), true)});
            }
        }
        const std::vector<BatchEnding> endings = make_runs(runs, request_, log_);
        for (std::size_t k = 0; k < runs.size(); ++k) {
            if (endings[k].exit_code == 0)
                continue;
            findings_.failed[runs[k].name] = endings[k].reason;
            if (!failed_)
                failed_.emplace(runs[k], endings[k]);
        }
    }

    /// Measures the runs that are there and not recorded, or all again.
    void measure_runs(const ValidationRun& run) {
        for (int seed : asked_of(run)) {
            const Origin from = finished(run, seed);
            if (from.state_hash.empty())
                continue;
            check_scene_of(run, seed);
            if (!request_.remeasure)
                check_recorded(run, seed, from);
            if (!is_to_be_measured(run, seed))
                continue;
            request_.stop.check();
            log_.say(fmt::format("measuring {}", folder_of(run, seed).string()));
            for (auto& [at, numbers] : examine_run(folder_of(run, seed), run.at))
                store_[{run.name, seed, at}] = {from, {numbers.begin(), numbers.end()}};
            save_measures(); // keeps the measures, whatever comes next
            renewed_.insert(run.name);
        }
    }

    /// Refuses measures of one run in the place of another's.
    void check_recorded(const ValidationRun& run, int seed, const Origin& from) const {
        for (double at : run.at)
            if (const auto m = store_.find({run.name, seed, at});
                m != store_.end() && m->second.from.state_hash != from.state_hash)
                throw UsageError(fmt::format(
                    "{}: is the run with state hash {}, and {} has measures of the one with {}; "
                    "--remeasure takes the run that is there",
                    folder_of(run, seed).string(), from.state_hash,
                    (findings_.beside / "measures.csv").string(), m->second.from.state_hash));
    }

    /// The states of a picture that are there; none if those of a row are missing, since half of a
    /// comparison shows nothing, or if a picture is there that shows more.
    std::vector<PicturedState> states_of(const ValidationPicture& picture, bool whole) const {
        std::vector<PicturedState> states;
        for (const auto& row : picture.rows) {
            const ValidationRun& run = findings_.plan.run(row.run);
            std::vector<int> seeds = findings_.seeds_of(run);
            if (row.seeds > 0 && std::ssize(seeds) > row.seeds)
                seeds.resize(static_cast<std::size_t>(row.seeds));
            const std::size_t before = states.size();
            for (int seed : seeds)
                if (!finished(run, seed).state_hash.empty())
                    states.push_back(
                        {folder_of(run, seed),
                         fmt::format("{}, seed {}, {}", row.run, seed, extension_text(row.at)),
                         row.at});
            if (states.size() == before || (whole && states.size() < before + seeds.size()))
                return {};
        }
        return states;
    }

    /// Draws a picture that is not there or has a run that was measured in this call.
    void draw(const ValidationPicture& picture) {
        const fs::path file = findings_.beside / (picture.name + ".png");
        const std::vector<PicturedState> states = states_of(picture, fs::exists(file));
        const bool renewed =
            !fs::exists(file) || std::ranges::any_of(picture.rows, [&](const auto& row) {
                return renewed_.contains(row.run);
            });
        if (states.empty() || !renewed)
            return;
        log_.say(fmt::format("drawing {}", file.string()));
        draw_states(states, "gallery", file, request_.stop);
    }

    const ValidationRequest& request_;
    fs::path runs_, document_;
    std::set<std::string> names_; ///< of the runs that this call is about
    std::vector<int> seeds_;      ///< that this call is about
    MeasureStore store_;
    ValidationFindings findings_;
    std::set<std::string> renewed_; ///< runs that were measured in this call
    std::map<std::pair<std::string, int>, std::string> planned_scenes_; ///< their hashes, by seed
    std::optional<std::pair<BatchRun, BatchEnding>> failed_;            ///< the first of them
    std::optional<FolderLock> lock_; ///< of the record: its measures are read once
    Log log_{request_.quiet};
};

} // namespace

void run_validation(const ValidationRequest& request) {
    const ValidationPlan plan = plan_of(request);
    check_accuracy(request.accuracy);
    Validation(request, plan).carry_out();
}

} // namespace listric
