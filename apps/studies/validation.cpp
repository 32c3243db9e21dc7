#include "apps/studies/validation.hpp"

#include "apps/archive/run_folder.hpp"
#include "apps/figures/figures.hpp"
#include "apps/laboratory/laboratory.hpp"
#include "apps/measures/fault_history.hpp"
#include "apps/measures/structure.hpp"
#include "apps/run/run.hpp"
#include "apps/scene/declaration.hpp"
#include "apps/studies/validation_plan.hpp"
#include "apps/support/statistics.hpp"
#include "apps/support/version.hpp"

#include "apps/archive/examine.hpp"
#include "apps/support/resources.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace listric {

using namespace dem;

namespace {

namespace fs = std::filesystem;

/// One run at one extension.
struct Place {
    std::string run;
    int seed = 0;
    double at = 0.0; ///< m
    auto operator<=>(const Place&) const = default;
};

/// Measures of one moment and the hash of the run that they come from.
struct Measured {
    std::string hash;
    std::map<std::string, double> numbers;
};

using Store = std::map<Place, Measured>;

void say(const std::string& text) {
    std::fwrite((text + "\n").data(), 1, text.size() + 1, stderr);
    std::fflush(stderr);
}

/// Hash in the summary of a finished run; empty if there is none.
std::string finished_hash(const fs::path& folder, const std::string& accuracy, int seed) {
    std::ifstream in(folder / "summary.json");
    const auto json = nlohmann::json::parse(in, nullptr, false);
    if (!json.is_object() || !json.value("finished", false))
        return {};
    const std::string has = json.value("accuracy", "");
    if (has != accuracy || json.value("seed", -1) != seed)
        throw UsageError(fmt::format("{}: a run at {} with seed {}, but {} with seed {} is wanted; "
                                     "--runs may name another folder",
                                     folder.string(), has, json.value("seed", -1), accuracy, seed));
    return json.value("state_hash", "");
}

Store read_store(const fs::path& file) {
    Store store;
    std::ifstream in(file);
    std::string line, cell;
    std::vector<std::string> names;
    while (std::getline(in, line)) {
        std::vector<std::string> cells;
        std::istringstream row(line + ",");
        while (std::getline(row, cell, ','))
            cells.push_back(cell);
        if (names.empty()) {
            names = cells;
            continue;
        }
        if (cells.size() != names.size() || cells.size() < 4)
            throw StorageError(file.string() + ": a line has another number of columns than the "
                                               "first; --remeasure writes it anew");
        Measured& m = store[{cells[0], std::atoi(cells[1].c_str()), std::atof(cells[2].c_str())}];
        m.hash = cells[3];
        for (std::size_t k = 4; k < cells.size(); ++k)
            if (!cells[k].empty())
                m.numbers[names[k]] = std::atof(cells[k].c_str());
    }
    return store;
}

void write_store(const fs::path& file, const Store& store) {
    std::set<std::string> names;
    for (const auto& [place, m] : store)
        for (const auto& [name, value] : m.numbers)
            names.insert(name);
    std::string text = fmt::format("run,seed,at_m,state_hash,{}\n", fmt::join(names, ","));
    for (const auto& [place, m] : store) {
        text += fmt::format("{},{},{},{}", place.run, place.seed, place.at, m.hash);
        for (const std::string& name : names) {
            const auto number = m.numbers.find(name);
            text += number == m.numbers.end() ? "," : fmt::format(",{:.6g}", number->second);
        }
        text += '\n';
    }
    write_text(file, text);
}

class Validation {
public:
    explicit Validation(const ValidationRequest& request)
        : request_(request),
          plan_(load_validation_plan(request.plan.empty()
                                         ? source_folder() / "apps/studies/validation.toml"
                                         : request.plan)),
          runs_(request.runs.empty() ? fs::path("out/validation-" + request.accuracy)
                                     : request.runs),
          document_(!request.output.empty() ? request.output
                    : request.accuracy == "standard" && !request.only
                        ? fs::path("docs/validation.md")
                        : runs_ / "validation.md"),
          beside_(document_.parent_path() / document_.stem()) {
        check();
        fs::create_directories(beside_);
        try {
            store_ = read_store(beside_ / "measures.csv");
        } catch (const StorageError&) {
            if (!request.remeasure)
                throw;
        }
    }

    bool carry_out() {
        for (const ValidationExperiment& x : chosen_)
            for (const std::string& name : x.runs) {
                if (!make_runs(plan_.run(name)))
                    return false;
                measure_runs(plan_.run(name));
            }
        write_store(beside_ / "measures.csv", store_);
        for (const ValidationExperiment& x : chosen_)
            for (const ValidationPicture& picture : x.pictures)
                draw(picture);
        write_text(document_, document());
        say(fmt::format("{}", document_.string()));
        return true;
    }

private:
    void check() {
        std::vector<std::string_view> levels, names;
        for (const AccuracyLevel& level : accuracy_levels())
            levels.push_back(level.name);
        if (std::ranges::find(levels, request_.accuracy) == levels.end())
            throw UsageError(fmt::format("--accuracy {}: there are {}", request_.accuracy,
                                         fmt::join(levels, ", ")));
        for (const ValidationExperiment& x : plan_.experiments) {
            names.push_back(x.name);
            if (!request_.only || *request_.only == x.name)
                chosen_.push_back(x);
        }
        if (chosen_.empty())
            throw UsageError(fmt::format("--only {}: there are {}", request_.only.value_or(""),
                                         fmt::join(names, ", ")));
    }

    int seeds_of(const ValidationRun& run) const {
        return run.seeds > 0 ? std::min(run.seeds, request_.seeds) : request_.seeds;
    }
    const std::string& accuracy_of(const ValidationRun& run) const {
        return run.accuracy.empty() ? request_.accuracy : run.accuracy;
    }
    fs::path folder_of(const ValidationRun& run, int seed) const {
        return runs_ / fmt::format("{}-{}", run.name, seed);
    }
    std::string hash_of(const ValidationRun& run, int seed) const {
        return finished_hash(folder_of(run, seed), accuracy_of(run), seed);
    }

    /// False if a run was interrupted.
    bool make_runs(const ValidationRun& run) {
        for (int seed = 1; seed <= seeds_of(run) && !request_.without_runs; ++seed) {
            if (!hash_of(run, seed).empty())
                continue;
            SceneRequest scene;
            scene.scene = run.scene;
            scene.set = run.set;
            scene.without = run.without;
            scene.accuracy = accuracy_of(run);
            scene.seed = seed;
            RunOptions options;
            options.stop = StopToken(stop_requested);
            options.output = folder_of(run, seed);
            options.threads = request_.threads;
            options.resume = true;
            if (run_scene(load_scene(scene), options) != RunOutcome::finished)
                return false;
        }
        return true;
    }

    /// The runs that are there, by seed.
    void measure_runs(const ValidationRun& run) {
        bool measured = false;
        for (int seed = 1; seed <= seeds_of(run); ++seed) {
            const std::string hash = hash_of(run, seed);
            const bool anew = request_.remeasure && !renewed_.contains(run.name);
            const bool known = !anew && std::ranges::all_of(run.at, [&](double at) {
                const auto m = store_.find({run.name, seed, at});
                return m != store_.end() && m->second.hash == hash;
            });
            if (known || hash.empty())
                continue;
            say(fmt::format("measuring {}", folder_of(run, seed).string()));
            for (auto& [at, numbers] : examine_run(folder_of(run, seed), run.at))
                store_[{run.name, seed, at}] = {hash, {numbers.begin(), numbers.end()}};
            measured = true;
        }
        if (measured)
            renewed_.insert(run.name);
    }

    /// The value of each seed that has run; an empty one where the measure has no meaning.
    std::vector<std::optional<double>> values(const Expectation& e, const std::string& of) const {
        const ValidationRun& run = plan_.run(of);
        const double at = e.at.value_or(run.at.back());
        std::vector<std::optional<double>> all;
        const auto number = [&](const std::string& name, int seed,
                                double where) -> std::optional<double> {
            const auto m = store_.find({name, seed, where});
            if (m == store_.end())
                return std::nullopt;
            const auto found = m->second.numbers.find(e.measure);
            return found == m->second.numbers.end() ? std::nullopt : std::optional(found->second);
        };
        for (int seed = 1; seed <= seeds_of(run); ++seed) {
            if (!store_.contains({of, seed, at}) ||
                (!e.minus.empty() && !store_.contains({e.minus, seed, at})))
                continue;
            std::optional<double> value = number(of, seed, at);
            const auto take_off = [&](std::optional<double> other) {
                value = value && other ? std::optional(*value - *other) : std::nullopt;
            };
            if (!e.minus.empty())
                take_off(number(e.minus, seed, at));
            if (e.since)
                take_off(number(of, seed, *e.since));
            all.push_back(value ? std::optional(*value / e.unit) : std::nullopt);
        }
        return all;
    }

    /// "38.20 ± 0.03 (38.17 to 38.24)"
    std::string summary(const Expectation& e, const std::vector<std::optional<double>>& all) const {
        std::vector<double> numbers;
        for (const auto& value : all)
            if (value)
                numbers.push_back(*value);
        if (numbers.empty())
            return all.empty() ? "" : "no value";
        const auto [low, high] = std::ranges::minmax(numbers);
        const Spread s = spread(numbers);
        std::string text = fmt::format("{:.{}f}", s.mean, e.digits);
        if (numbers.size() > 1)
            text += fmt::format(" ± {:.{}f} ({:.{}f} to {:.{}f})", s.deviation, e.digits, low,
                                e.digits, high, e.digits);
        if (numbers.size() < all.size())
            text += fmt::format(", {} without", all.size() - numbers.size());
        return text;
    }

    static std::string extension(double at) { return fmt::format("{:g} km", at / 1e3); }

    void draw(const ValidationPicture& picture) {
        const fs::path file = beside_ / (picture.name + ".png");
        std::vector<std::tuple<std::string, int, double>> frames;
        bool renewed = !fs::exists(file);
        for (const auto& row : picture.rows) {
            const ValidationRun& run = plan_.run(row.run);
            const int seeds = row.seeds > 0 ? std::min(row.seeds, seeds_of(run)) : seeds_of(run);
            const std::size_t before = frames.size();
            for (int seed = 1; seed <= seeds; ++seed)
                if (!hash_of(run, seed).empty())
                    frames.emplace_back(row.run, seed, row.at);
            if (frames.size() == before)
                return; // half of a comparison shows nothing
            renewed |= renewed_.contains(row.run);
        }
        if (frames.empty() || !renewed)
            return;
        say(fmt::format("drawing {}", file.string()));
        FigureFrames figure(beside_);
        for (const auto& [name, seed, at] : frames) {
            RunFolder folder(folder_of(plan_.run(name), seed));
            const fs::path path = *std::ranges::min_element(
                folder.snapshots, {}, [at = at](const fs::path& snapshot) {
                    return std::abs(snapshot_extension(snapshot) - at);
                });
            const Moment moment = folder.read(path);
            folder.scene.description = fmt::format("{}, seed {}, {}", name, seed, extension(at));
            figure.add(folder.scene, moment.state, folder.base, moment.events,
                       report_faults(folder.scene, folder.base, moment.state, folder.snapshots));
        }
        figure.draw("gallery");
        fs::rename(beside_ / "gallery.png", file);
    }

    // ------------------------------------------------------------------------------- document

    /// Names of an experiment's runs: those that are there, and all.
    std::pair<std::set<std::string>, std::set<std::string>>
    runs_of(const ValidationExperiment& x) const {
        std::set<std::string> present, all;
        for (const std::string& name : x.runs)
            for (int seed = 1; seed <= seeds_of(plan_.run(name)); ++seed) {
                all.insert(fmt::format("{}-{}", name, seed));
                if (!hash_of(plan_.run(name), seed).empty())
                    present.insert(fmt::format("{}-{}", name, seed));
            }
        return {present, all};
    }

    std::string head() const {
        std::set<std::string> wanted, there; // experiments may share runs
        for (const ValidationExperiment& x : chosen_) {
            auto [present, all] = runs_of(x);
            there.merge(present);
            wanted.merge(all);
        }
        std::string text = fmt::format(
            "# Validation\n\n"
            "Made by `listric validate` from the files of {} of {} runs at accuracy {}, up to {} "
            "seeds each; do not edit. What is expected, and by whom, is in "
            "`apps/validation.toml`; [measures.md](measures.md) defines the measures; "
            "[measures.csv]({}/measures.csv) has every number.\n\n",
            there.size(), wanted.size(), request_.accuracy, request_.seeds,
            document_.stem().string());
        text += "A value is the mean over the seeds ± its standard deviation (smallest to "
                "largest). *Met* says how many seeds fulfil the expectation; where it asks for "
                "most seeds or for the mean, that decides. Rows of kind *kinematics* check the "
                "machinery: a hanging wall that slides on that detachment has them with any "
                "material, faults or none, so meeting them says nothing about faults. Rows of "
                "kind *faults* are what the paper is about. Rows of kind *conservation* are "
                "bookkeeping.\n\n";
        text += "| experiment | runs | kinematics | faults | conservation |\n"
                "|---|---|---|---|---|\n";
        for (const ValidationExperiment& x : chosen_) {
            const auto [present, all] = runs_of(x);
            text += fmt::format("| {} | {} of {} |", x.title, present.size(), all.size());
            for (auto kind : {Expectation::Kind::kinematics, Expectation::Kind::faults,
                              Expectation::Kind::conservation}) {
                int met = 0, judged = 0;
                for (const Expectation& e : x.expectations)
                    if (const Verdict v = judge(e, values(e, e.run));
                        e.kind == kind && v.of > 0 && e.is_judged()) {
                        ++judged;
                        met += v.fulfilled;
                    }
                text += judged ? fmt::format(" {} of {} |", met, judged) : " |";
            }
            text += '\n';
        }
        return text + "\n";
    }

    std::string table(const ValidationExperiment& x) const {
        const bool beside = !x.compare.empty();
        std::string text = "| kind | measure | expected | by | this program |";
        text += beside ? fmt::format(" {} | verdict |\n|---|---|---|---|---|---|---|\n", x.compare)
                       : " verdict |\n|---|---|---|---|---|---|\n";
        constexpr const char* kinds[] = {"kinematics", "faults", "conservation"};
        for (const Expectation& e : x.expectations) {
            const auto all = values(e, e.run);
            const Verdict v = judge(e, all);
            std::string what = e.what;
            if (plan_.run(e.run).at.size() > 1 || e.at)
                what += ", " + extension(e.at.value_or(plan_.run(e.run).at.back()));
            text += fmt::format("| {} | {} (`{}`) | {} | {} | {} |",
                                kinds[static_cast<std::size_t>(e.kind)], what, e.measure,
                                e.target(), e.source, summary(e, all));
            if (beside)
                text += fmt::format(" {} |", e.run == x.runs.front() && e.minus.empty()
                                                 ? summary(e, values(e, x.compare))
                                                 : "");
            text += fmt::format(" {} |\n", v.text);
        }
        return text;
    }

    std::string document() const {
        std::string text = head();
        for (const ValidationExperiment& x : chosen_) {
            text += fmt::format("## {}\n\n", x.title);
            if (!x.about.empty())
                text += x.about + "\n\n";
            text += table(x) + "\n";
            for (const ValidationPicture& picture : x.pictures)
                if (const fs::path file = beside_ / (picture.name + ".png"); fs::exists(file))
                    text += fmt::format("![{}]({}/{})\n\n*{}*\n\n", picture.name,
                                        document_.stem().string(), file.filename().string(),
                                        picture.caption);
            if (!x.seen.empty() && request_.accuracy == "standard")
                text += x.seen + "\n\n";
            const auto [present, all] = runs_of(x);
            std::vector<std::string> missing;
            std::ranges::set_difference(all, present, std::back_inserter(missing));
            if (!missing.empty())
                text += fmt::format("Runs that were not there: {}.\n\n", fmt::join(missing, ", "));
        }
        text.pop_back();
        return text;
    }

    const ValidationRequest& request_;
    ValidationPlan plan_;
    fs::path runs_, document_, beside_;
    std::vector<ValidationExperiment> chosen_;
    Store store_;
    std::set<std::string> renewed_; ///< runs that were measured in this call
};

} // namespace

bool run_validation(const ValidationRequest& request) { return Validation(request).carry_out(); }

} // namespace listric
