#include "apps/studies/dataset/dataset.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/output_folder.hpp"
#include "apps/archive/folder/provenance.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/figures/sections/seismic_section.hpp"
#include "apps/run/exit_code.hpp"
#include "apps/studies/dataset/dataset_card.hpp"
#include "apps/studies/dataset/section_file.hpp"
#include "apps/studies/sweep/sweep_table.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/files/sha256.hpp"
#include "apps/support/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace listric {

namespace fs = std::filesystem;

namespace {

/// Numbers of a section that the index has.
constexpr const char* indexed[] = {"extension_m", "frequency_hz", "quality", "noise",
                                   "lateral_m",   "layer_m",      "faults",  "marked_throw_m"};

std::string sha256_of(const std::string& text) {
    Sha256 hash;
    hash.add(std::as_bytes(std::span(text.data(), text.size())));
    return hash.hexadecimal();
}

class Dataset {
public:
    explicit Dataset(const DatasetRequest& request)
        : request_(request), plan_(load_dataset_plan(request.plan)),
          points_(sweep_points(plan_.sweep)), settings_hash_(sha256_of(plan_.text)),
          output_(request.output.empty() ? fs::path("out/dataset-" + plan_.sweep.name)
                                         : request.output),
          runs_(request.runs.empty() ? fs::path("out/sweep-" + plan_.sweep.name) : request.runs),
          log_(request.quiet) {
        archive::require_no_run(output_);
        archive::require_own(
            std::vector<archive::OwnFile>{{output_ / "index.csv", "section,split,"},
                                          {output_ / "dataset.json", "listric dataset"},
                                          {output_ / "README.md", "listric dataset"}},
            {});
        make_folder(output_ / "sections");
        lock_.emplace(output_);
    }

    bool carry_out() {
        std::vector<SweepRow> rows = sweep_rows(plan_.sweep, points_, runs_);
        find_runs(rows);
        std::string index = head();
        std::vector<SplitCount> counts{{"train"}, {"validation"}, {"test"}};
        std::size_t missing = 0;
        for (SweepRow& row : rows) {
            request_.stop.check();
            const std::string_view split = plan_.split_of(points_[row.run - 1]);
            const auto record = row.failed() ? std::nullopt : section_of(row);
            index += line(row, split, record);
            if (!record) {
                ++missing;
                continue;
            }
            SplitCount& count = *std::ranges::find(counts, split, &SplitCount::name);
            ++count.sections;
            count.faults += static_cast<std::size_t>(record->numbers.at("faults"));
            count.bytes += fs::file_size(file_of(row));
        }
        write_text(output_ / "plan.toml", read_text(plan_file(request_.plan)));
        write_object(output_ / "dataset.json", description_of(plan_));
        write_text(output_ / "README.md", card_of(plan_, counts, missing));
        write_text(output_ / "index.csv", index); // the last: it names what is there
        log_.say(fmt::format("{}: {} sections{}", (output_ / "index.csv").string(),
                             rows.size() - missing,
                             missing > 0 ? fmt::format("; {} runs have none", missing) : ""));
        return missing < rows.size();
    }

private:
    std::string name_of(const SweepRow& row) const {
        return fmt::format("{:04}-seed={}", row.run, row.seed);
    }
    fs::path file_of(const SweepRow& row) const {
        return output_ / "sections" / (name_of(row) + ".h5");
    }

    /// Makes the runs that are missing, or looks which are there.
    void find_runs(std::vector<SweepRow>& rows) {
        std::vector<BatchRun> runs;
        for (const SweepRow& row : rows) {
            request_.stop.check();
            log_.progress(
                fmt::format("reading the scene of run {} of {}", runs.size() + 1, rows.size()));
            runs.push_back({name_of_row(plan_.sweep, points_, row),
                            scene_of_row(plan_.sweep, request_.plan, points_, row),
                            request_.options_of_run(row.folder)});
            runs.back().options.lean = Lean::all;
        }
        require_seismics(runs);
        std::vector<BatchEnding> endings;
        if (!request_.so_far)
            endings = make_runs(runs, request_, log_);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            BatchEnding ending;
            if (!request_.so_far)
                ending = endings[k];
            else if (!archive::is_finished(runs[k].scene, rows[k].folder))
                ending = known_ending(runs[k]).value_or(
                    BatchEnding{static_cast<int>(ExitCode::interrupted), not_yet});
            rows[k].exit_code = ending.exit_code;
            rows[k].outcome = ending.reason.empty() ? "finished" : ending.reason;
        }
    }

    void require_seismics(const std::vector<BatchRun>& runs) const {
        for (const BatchRun& run : runs)
            if (!has_seismics(run.scene))
                throw UsageError(fmt::format("{}: {}: seismics need a hanging wall of 1 km or more "
                                             "(hanging_wall.thickness_m)",
                                             plan_file(request_.plan).string(), run.name));
    }

    /// The section of a finished run, made if it is not there. None where the run has no moment
    /// before its end.
    std::optional<SectionRecord> section_of(SweepRow& row) {
        const JsonObject summary = read_object(row.folder / "summary.json");
        row.state_hash = text_at(summary, "state_hash");
        row.made_by = archive::makers_of(row.folder);
        const std::string made_of =
            fmt::format("state {}, run {}, settings {}, by {}, measures {}", row.state_hash,
                        row.run, settings_hash_, version, measures_hash);
        const fs::path file = file_of(row);
        if (const auto there = read_section_record(file); there && there->made_of == made_of)
            return there;
        log_.progress(fmt::format("section {}", name_of(row)));
        const archive::RunFolder run(row.folder);
        if (run.snapshots.size() < 2) {
            row.outcome = "has no snapshot before the last one, for faults; it is of another call: "
                          "remove its folder";
            row.exit_code = static_cast<int>(ExitCode::bad_call);
            return std::nullopt;
        }
        return write_section(file, labelled_section(run, plan_.settings, row.run), made_of);
    }

    std::string head() const {
        std::string text = "section,split,file,run,seed";
        for (const SweepParameter& parameter : plan_.sweep.parameters)
            text += "," + parameter.name;
        text += ",outcome";
        for (const char* name : indexed)
            text += std::string(",") + name;
        return text + ",state_hash,made_by,sha256\n";
    }

    std::string line(const SweepRow& row, std::string_view split,
                     const std::optional<SectionRecord>& record) const {
        std::string text =
            fmt::format("{},{},{},{},{}", name_of(row), split,
                        record ? "sections/" + name_of(row) + ".h5" : "", row.run, row.seed);
        for (const SweepValue& value : points_[row.run - 1])
            text += "," + csv_cell(value.text);
        text += "," + csv_cell(row.outcome);
        for (const char* name : indexed)
            text += record ? fmt::format(",{:.6g}", record->numbers.at(name)) : ",";
        return text + fmt::format(",{},{},{}\n", row.state_hash, csv_cell(row.made_by),
                                  record ? record->sha256 : "");
    }

    const DatasetRequest& request_;
    DatasetPlan plan_;
    std::vector<SweepPoint> points_;
    std::string settings_hash_;
    fs::path output_, runs_;
    std::optional<archive::FolderLock> lock_;
    Log log_;
};

} // namespace

bool make_dataset(const DatasetRequest& request) { return Dataset(request).carry_out(); }

} // namespace listric
