#include "apps/studies/sweep/sweep.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/output_folder.hpp"
#include "apps/archive/folder/provenance.hpp"
#include "apps/archive/folder/scene_lines.hpp"
#include "apps/run/batch.hpp"
#include "apps/run/exit_code.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/scene/toml/toml.hpp"
#include "apps/studies/pictured_states.hpp"
#include "apps/studies/sweep/sweep_effects.hpp"
#include "apps/studies/sweep/sweep_plan.hpp"
#include "apps/studies/sweep/sweep_table.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/memory.hpp"
#include "apps/support/machine/python.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <optional>
#include <set>

namespace listric {

using namespace archive;

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_on_sheet = 100;

/// The measures of a finished run, none where it has no such number.
std::vector<std::optional<double>> measures_of(const SweepPlan& plan, const fs::path& folder,
                                               const JsonObject& summary) {
    std::set<double> extensions;
    for (const SweepMeasure& measure : plan.measures)
        if (measure.at)
            extensions.insert(*measure.at);
    const std::vector<double> at(extensions.begin(), extensions.end());
    const auto earlier =
        at.empty() ? std::vector<std::pair<double, NamedNumbers>>{} : examine_run(folder, at);
    std::vector<std::optional<double>> values;
    for (const SweepMeasure& measure : plan.measures) {
        values.emplace_back();
        if (!measure.at) {
            values.back() = number_at(summary, measure.name.c_str());
            continue;
        }
        for (const auto& [extension, numbers] : earlier)
            for (const auto& [name, number] : numbers)
                if (extension == *measure.at && name == measure.name)
                    values.back() = number;
    }
    return values;
}

class Sweep {
public:
    explicit Sweep(const SweepRequest& request)
        : request_(request), plan_(load_sweep_plan(request.plan)), points_(sweep_points(plan_)),
          output_(sweep_folder(request, plan_)), log_(request.quiet) {
        std::vector<OwnFile> written{{output_ / "sweep.csv", "run,seed,"},
                                     {output_ / "effects.csv", "measure,term,effect"},
                                     {output_ / "effects.png", "Listric"}};
        if (!fs::exists(output_ / "sweep.csv")) // else the sheet beside it is the sweep's
            written.push_back({output_ / "sheet.png", "Listric"});
        require_own(written, {});
        make_folder(output_);
        lock_.emplace(output_);
    }

    bool carry_out() {
        const std::vector<SweepRow> rows = request_.merge.empty() ? make() : merge();
        write_text(output_ / "sweep.csv", to_csv(plan_, points_, rows));
        if (!request_.merge.empty())
            warn_of_versions(rows);
        const auto awaited = std::ranges::count(rows, not_yet, &SweepRow::outcome);
        const auto failed =
            std::ranges::count_if(rows, [](const SweepRow& r) { return r.failed(); }) - awaited;
        log_.say(fmt::format("{}: {} runs{}{}", (output_ / "sweep.csv").string(), rows.size(),
                             failed ? fmt::format(", {} of them failed", failed) : "",
                             awaited ? fmt::format(", {} not finished yet", awaited) : ""));
        if (!request_.task) {
            warn_of_empty_columns(rows);
            write_effects(rows);
            draw_sheet_or_warn(rows);
        }
        return rows.empty() || failed < std::ssize(rows);
    }

private:
    std::string name_of(const SweepRow& row) const { return name_of_row(plan_, points_, row); }

    Scene scene_of(const SweepRow& row) const {
        return scene_of_row(plan_, request_.plan, points_, row);
    }

    /// Refuses a run that was made by another plan.
    void check_run(const SweepRow& row) const {
        const fs::path file = row.folder / "scene.toml";
        const std::string there = read_text_if_there(file);
        const auto differs = there.empty() ? std::nullopt
                                           : scene_difference(scene_values(there),
                                                              scene_values(to_toml(scene_of(row))));
        if (differs) {
            const auto [there_is, asked] = shown_apart(differs->one, differs->other);
            throw UsageError(fmt::format("--merge: {}: is of another plan: {} = {} there, {} in {}",
                                         file.string(), shown(differs->parameter), there_is, asked,
                                         request_.plan.string()));
        }
        const std::string state = text_at(object_in(row.folder / "summary.json"), "state_hash");
        if (!state.empty() && state != row.state_hash)
            throw UsageError(
                fmt::format("--merge: {}: is newer than its row in {}: make that "
                            "task's table again, by its call with --task",
                            (row.folder / "summary.json").string(),
                            (row.folder / "../../sweep.csv").lexically_normal().string()));
    }

    /// Tells of rows that other versions have made.
    void warn_of_versions(const std::vector<SweepRow>& rows) {
        std::set<std::string> makers;
        for (const SweepRow& row : rows)
            if (!row.failed() && row.made_by != version)
                makers.insert(row.made_by);
        if (!makers.empty())
            log_.say(fmt::format("warning: not all runs are of this version, {}: some are by {} "
                                 "(column made_by); numbers may differ",
                                 version, fmt::join(makers, "; ")));
    }

    /// The rows that are asked for.
    std::vector<SweepRow> asked() const {
        const SweepTask task = request_.task.value_or(SweepTask{});
        std::vector<SweepRow> rows = sweep_rows(plan_, points_, output_);
        int number = 0;
        std::erase_if(rows, [&](const SweepRow&) { return number++ % task.of != task.number - 1; });
        return rows;
    }

    /// Takes what a finished run has left.
    void read_finished(SweepRow& row) const {
        const JsonObject summary = read_object(row.folder / "summary.json");
        row.outcome = "finished";
        row.state_hash = text_at(summary, "state_hash");
        row.made_by = archive::makers_of(row.folder);
        row.measures = measures_of(plan_, row.folder, summary);
    }

    void read_ending(SweepRow& row, const BatchEnding& ending) const {
        row.exit_code = ending.exit_code;
        row.outcome = ending.reason;
        row.measures.resize(plan_.measures.size());
    }

    std::vector<SweepRow> make() {
        std::vector<SweepRow> rows = asked();
        std::vector<BatchRun> runs;
        for (const SweepRow& row : rows) {
            request_.stop.check();
            log_.progress(
                fmt::format("reading the scene of run {} of {}", runs.size() + 1, rows.size()));
            runs.push_back({name_of(row), scene_of(row), request_.options_of_run(row.folder)});
            if (request_.is_lean)
                runs.back().options.lean = plan_.needs_moments() ? Lean::all : Lean::last;
        }
        const std::vector<BatchEnding> endings = make_runs(runs, request_, log_);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            request_.stop.check();
            log_.progress(fmt::format("measuring run {} of {}", k + 1, rows.size()));
            if (endings[k].reason.empty())
                read_finished(rows[k]);
            else
                read_ending(rows[k], endings[k]);
        }
        return rows;
    }

    /// Reads a run that a call of its own has made in one of the folders. False: it is in none of
    /// them, or not finished.
    bool read_run(SweepRow& row) const {
        for (const fs::path& folder : request_.merge) {
            row.folder = folder / "runs" / row.folder.filename();
            if (!fs::exists(row.folder / "scene.toml"))
                continue;
            BatchRun run{"", scene_of(row), {}};
            run.options.output = row.folder;
            if (is_finished(run.scene, row.folder)) {
                read_finished(row);
                return true;
            }
            check_run(row); // another plan's would never finish
            if (const auto ending = known_ending(run)) {
                read_ending(row, *ending);
                return true;
            }
        }
        return false;
    }

    /// The rows that tasks have left.
    std::vector<SweepRow> rows_of_tasks() const {
        std::vector<SweepRow> rows;
        for (const fs::path& folder : request_.merge) {
            if (!fs::exists(folder / "sweep.csv") && fs::is_directory(folder / "runs"))
                continue;
            for (SweepRow& row : read_sweep(plan_, points_, folder / "sweep.csv")) {
                if (row.outcome == not_yet)
                    continue;
                row.folder = folder / "runs" / fmt::format("{:04}-seed={}", row.run, row.seed);
                if (!row.failed())
                    check_run(row);
                rows.push_back(std::move(row));
            }
        }
        const auto place = [](const SweepRow& row) { return std::pair(row.run, row.seed); };
        std::ranges::sort(rows, {}, place);
        const auto twice = std::ranges::adjacent_find(rows, {}, place);
        if (twice != rows.end())
            throw UsageError(fmt::format("--merge: run {}, seed {} is in {} and in {}", twice->run,
                                         twice->seed, twice->folder.parent_path().string(),
                                         std::next(twice)->folder.parent_path().string()));
        return rows;
    }

    /// All rows, from the tables of tasks or from the runs themselves.
    std::vector<SweepRow> merge() {
        const auto place = [](const SweepRow& row) { return std::pair(row.run, row.seed); };
        const std::vector<SweepRow> tables = rows_of_tasks();
        std::vector<SweepRow> rows = asked();
        std::size_t missing = 0;
        for (SweepRow& row : rows) {
            request_.stop.check();
            log_.progress(fmt::format("reading run {} of {}", &row - rows.data() + 1, rows.size()));
            const auto known = std::ranges::lower_bound(tables, place(row), {}, place);
            if (known != tables.end() && place(*known) == place(row))
                row = *known;
            else if (!read_run(row))
                ++missing, read_ending(row, {static_cast<int>(ExitCode::interrupted), not_yet});
        }
        const auto first = std::ranges::find(rows, not_yet, &SweepRow::outcome);
        if (missing > 0 && !request_.so_far)
            throw UsageError(
                fmt::format("--merge: run {}, seed {} is in none of the folders, or not "
                            "finished{}; name all folders, or take --so-far",
                            first->run, first->seed,
                            missing > 1 ? fmt::format(", like {} more", missing - 1) : ""));
        return rows;
    }

    void warn_of_empty_columns(const std::vector<SweepRow>& rows) {
        for (std::size_t m = 0; m < plan_.measures.size(); ++m)
            if (std::ranges::none_of(rows,
                                     [&](const SweepRow& r) { return r.measures[m].has_value(); }))
                log_.say(
                    fmt::format("warning: no run has the measure {} (docs/reference/measures.md)",
                                plan_.measures[m].text));
    }

    void write_effects(const std::vector<SweepRow>& rows) {
        const std::vector<SweepFactor> factors = factors_of(plan_, points_, rows);
        std::vector<std::size_t> run;
        std::vector<int> seed;
        for (const SweepRow& row : rows) {
            run.push_back(row.run);
            // Seeds of its own that a point has are as good as the other points'.
            seed.push_back(plan_.own_seeds ? (row.seed - plan_.first_seed) % plan_.seeds
                                           : row.seed);
        }
        std::vector<SweepEffect> effects;
        for (std::size_t m = 0; m < plan_.measures.size(); ++m) {
            std::vector<std::optional<double>> values;
            for (const SweepRow& row : rows)
                values.push_back(row.measures[m]);
            std::ranges::move(effects_on(plan_.measures[m].text, factors, run, seed, values),
                              std::back_inserter(effects));
        }
        for (const SweepFactor& factor : factors)
            if (!factor.word.empty())
                log_.say(fmt::format("{} has more than two words, which have no order: effects.csv "
                                     "has no effect of it",
                                     factor.name));
        write_text(output_ / "effects.csv", effects_csv(effects));
        std::cout << effects_text(effects);
        if (const std::string text = warning_of_few(plan_.seeds); !factors.empty() && !text.empty())
            log_.say("warning: " + text);
        if (!effects.empty())
            draw_or_warn("effects.py", {fs::absolute(output_).string()});
    }

    /// Draws the last state of every point, by its first seed that is finished. The tables need not
    /// wait for it: the runs may be elsewhere.
    void draw_sheet_or_warn(const std::vector<SweepRow>& rows) {
        std::vector<PicturedState> states;
        std::size_t last = 0;
        for (const SweepRow& row : rows)
            if (!row.failed() && row.run != last && states.size() < most_on_sheet) {
                last = row.run;
                states.push_back({row.folder, name_of(row)});
            }
        try {
            if (!states.empty())
                draw_states(states, "multiples", output_ / "sheet.png", request_.stop);
        } catch (const std::exception& error) {
            log_.say(std::string("warning: no sheet.png: ") + words_of(error));
        }
    }

    const SweepRequest& request_;
    SweepPlan plan_;
    std::vector<SweepPoint> points_;
    fs::path output_;
    std::optional<FolderLock> lock_;
    Log log_;
};

} // namespace

fs::path sweep_folder(const SweepRequest& request, const SweepPlan& plan) {
    if (!request.output.empty())
        return request.output;
    const std::string task =
        request.task ? fmt::format("-{}-of-{}", request.task->number, request.task->of) : "";
    return fmt::format("out/sweep-{}{}", plan.name, task);
}

bool run_sweep(const SweepRequest& request) { return Sweep(request).carry_out(); }

} // namespace listric
