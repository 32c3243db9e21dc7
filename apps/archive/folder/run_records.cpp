#include "apps/archive/folder/run_records.hpp"

#include "apps/measures/dictionary.hpp"
#include "apps/measures/faults/main_faults.hpp"
#include "apps/model/measure_names.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/resources.hpp"
#include "apps/support/words/number.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace listric::archive {

namespace fs = std::filesystem;

namespace {

struct WordColumn {
    std::string_view name;
    std::string RecordedRun::*word;
};
constexpr WordColumn word_columns[] = {{"record", &RecordedRun::record},
                                       {"scene", &RecordedRun::scene},
                                       {"made_by", &RecordedRun::made_by}};

struct NumberColumn {
    std::string_view name;
    double& (*number)(RecordedRun& run);
};
constexpr NumberColumn number_columns[] = {
    {"mean_radius_m", [](RecordedRun& run) -> double& { return run.mean_radius; }},
    {"speed_m_per_s", [](RecordedRun& run) -> double& { return run.pace.speed; }},
    {"ramp_s", [](RecordedRun& run) -> double& { return run.pace.ramp; }},
    {"softness", [](RecordedRun& run) -> double& { return run.pace.softness; }},
    {"extension_m", [](RecordedRun& run) -> double& { return run.extension; }}};

/// Puts a cell where its column's name says.
void take_cell(RecordedRun& run, const std::string& column, const std::string& cell) {
    if (const auto word = std::ranges::find(word_columns, column, &WordColumn::name);
        word != std::end(word_columns)) {
        run.*word->word = cell;
        return;
    }
    const auto number = std::ranges::find(number_columns, column, &NumberColumn::name);
    const bool is_needed = number != std::end(number_columns) || column == "seed";
    if (cell.empty() && !is_needed)
        return;
    const auto value = parse_number(cell);
    if (!value)
        throw SceneError(fmt::format("{}: {}", column, no_number(cell)));
    if (number != std::end(number_columns))
        number->number(run) = *value;
    else if (column == "seed")
        run.seed = static_cast<int>(std::clamp(*value, -2e9, 2e9));
    else
        run.measures[column] = *value;
}

/// The name of the one measure of faults that is in diameters.
std::string fault_width() {
    using FaultMeasure = Measure<measures::FaultReport>;
    return std::string(
        std::ranges::find(measures::fault_report_measures(), "diameters", &FaultMeasure::unit)
            ->name);
}

/// Throws SceneError unless a header names all that a run needs, and nothing else.
void require_header(const std::vector<std::string>& header) {
    std::vector<std::string_view> needed{"seed"}, allowed;
    for (const WordColumn& column : word_columns)
        needed.push_back(column.name);
    for (const NumberColumn& column : number_columns)
        needed.push_back(column.name);
    for (const std::string_view name : needed)
        if (std::ranges::count(header, name) != 1)
            throw SceneError(fmt::format("has no column {}", name));
    for (const std::string& name : header)
        if (!std::ranges::count(needed, name) &&
            !std::ranges::count(headline_measures(), name, &HeadlineMeasure::key))
            throw SceneError(fmt::format("{} is no column of recorded runs", name));
}

} // namespace

std::span<const HeadlineMeasure> headline_measures() {
    using M = measures::Measures;
    using measures::name_of;
    static const HeadlineMeasure all[] = {{name_of<&M::rollover_tilt>(), "tilt"},
                                          {name_of<&M::cutoff, &dem::Point::x>(), "cutoff"},
                                          {name_of<&M::cutoff, &dem::Point::y>(), "cutoff"},
                                          {name_of<&M::basin_area>(), "area"},
                                          {name_of<&M::area_balance>(), "balance"},
                                          {name_of<&M::halfgraben_area_share>(), "halfgraben"},
                                          {name_of<&M::strain_top10>(), "top10"},
                                          {name_of<&M::strain_top10_cumulative>(), "cumulative"},
                                          {name_of<&M::basement_unbonded_fraction>(), "unbonded"},
                                          {effects::weak_fraction, "weak"},
                                          {fault_width(), "width"},
                                          {std::string(measures::antithetic_foot), "antithetic"}};
    return all;
}

std::vector<RecordedRun> read_run_records(const fs::path& file) {
    std::vector<RecordedRun> runs;
    std::vector<std::string> header;
    const auto take = [&](const CsvRecord& record) {
        try {
            if (header.empty()) {
                require_header(header = record.cells);
                return true;
            }
            if (record.cells.size() != header.size())
                throw SceneError("has another number of columns than the first line");
            RecordedRun& run = runs.emplace_back();
            for (std::size_t k = 0; k < header.size(); ++k)
                take_cell(run, header[k], record.cells[k]);
        } catch (const SceneError& error) {
            throw StorageError(
                fmt::format("{}: {}", csv_place(file.string(), record.line), error.what()));
        }
        return true;
    };
    try {
        read_records(read_text(file), file.string(), ',', take);
    } catch (const SceneError& error) {
        throw StorageError(error.what());
    }
    return runs;
}

void write_run_records(const fs::path& file, std::span<const RecordedRun> runs) {
    std::string text;
    for (const WordColumn& column : word_columns)
        text += fmt::format("{},", column.name);
    for (const NumberColumn& column : number_columns)
        text += fmt::format("{},", column.name);
    text += "seed";
    for (const HeadlineMeasure& measure : headline_measures())
        text += "," + measure.key;
    text += '\n';
    for (RecordedRun run : runs) {
        for (const WordColumn& column : word_columns)
            text += csv_cell(run.*column.word) + ",";
        for (const NumberColumn& column : number_columns)
            text += fmt::format("{:.6g},", column.number(run));
        text += std::to_string(run.seed);
        for (const HeadlineMeasure& measure : headline_measures()) {
            const auto found = run.measures.find(measure.key);
            text += found == run.measures.end() ? "," : fmt::format(",{:.6g}", found->second);
        }
        text += '\n';
    }
    write_text(file, text);
}

std::vector<RecordedRun> recorded_runs() {
    std::error_code error;
    std::vector<fs::path> files = list_folder(record_folder(), error);
    std::erase_if(files, [](const fs::path& file) { return file.extension() != ".csv"; });
    std::ranges::sort(files);
    std::vector<RecordedRun> all;
    for (const fs::path& file : files) {
        const std::vector<RecordedRun> runs = read_run_records(file);
        all.insert(all.end(), runs.begin(), runs.end());
    }
    return all;
}

} // namespace listric::archive
