#include "apps/studies/sweep/sweep_table.hpp"

#include "apps/support/error.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/words/number.hpp"
#include "apps/support/words/text.hpp"
#include "dem/numbers/elementary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace listric {

namespace {

std::string header(const SweepPlan& plan) {
    std::string text = "run,seed";
    for (const SweepParameter& parameter : plan.parameters)
        text += "," + parameter.name;
    text += ",outcome,exit_code,state_hash,made_by";
    for (const SweepMeasure& measure : plan.measures)
        text += "," + measure.text;
    return text;
}

/// A text as one cell.
std::string cell(std::string text) {
    std::ranges::replace(text, ',', ';');
    std::ranges::replace(text, '"', '\'');
    std::ranges::replace(text, '\n', ' ');
    return text;
}

std::string replaced_once(std::string text, std::string_view what, std::string_view by) {
    const std::size_t at = text.find(what);
    return at == text.npos ? text : text.replace(at, what.size(), by);
}

/// Whether values go up by factors, as those of permeability do: three or more, the greatest at
/// least a hundred times the least, their median nearer to the ends' geometric than to their
/// arithmetic mean. Samples of a range go up by differences.
bool go_by_factors(std::span<const double> numbers) {
    const std::set<double> sorted(numbers.begin(), numbers.end());
    const double least = *sorted.begin(), greatest = *sorted.rbegin();
    if (sorted.size() < 3 || least <= 0.0 || greatest < 100.0 * least)
        return false;
    const double median = *std::next(sorted.begin(), static_cast<long>(sorted.size() / 2));
    return median * median < std::sqrt(least * greatest) * 0.5 * (least + greatest);
}

} // namespace

std::vector<SweepRow> sweep_rows(const SweepPlan& plan, std::span<const SweepPoint> points,
                                 const std::filesystem::path& folder) {
    std::vector<SweepRow> rows;
    for (std::size_t run = 1; run <= points.size(); ++run)
        for (int k = 0; k < plan.seeds; ++k) {
            const int before = plan.own_seeds ? static_cast<int>(run - 1) * plan.seeds : 0;
            rows.push_back({run, plan.first_seed + before + k});
            rows.back().folder =
                folder / "runs" / fmt::format("{:04}-seed={}", run, rows.back().seed);
        }
    return rows;
}

std::string name_of_row(const SweepPlan& plan, std::span<const SweepPoint> points,
                        const SweepRow& row) {
    return name_of_point(plan, row.run - 1, points[row.run - 1],
                         fmt::format(", seed {}", row.seed));
}

Scene scene_of_row(const SweepPlan& plan, const std::filesystem::path& file,
                   std::span<const SweepPoint> points, const SweepRow& row) {
    try {
        return scene_at(plan, points[row.run - 1], row.seed);
    } catch (const SceneError& error) {
        fail(
            fmt::format("{}: {}: {}", file.string(), name_of_row(plan, points, row), error.what()));
    }
}

std::string to_csv(const SweepPlan& plan, std::span<const SweepPoint> points,
                   std::span<const SweepRow> rows) {
    std::string text = header(plan) + "\n";
    for (const SweepRow& row : rows) {
        text += fmt::format("{},{}", row.run, row.seed);
        for (const SweepValue& value : points[row.run - 1])
            text += fmt::format(",{}", csv_cell(value.text));
        text += fmt::format(",{},{},{},{}", csv_cell(cell(row.outcome)), row.exit_code,
                            row.state_hash, csv_cell(cell(row.made_by)));
        for (const std::optional<double>& measure : row.measures)
            text += measure ? fmt::format(",{}", *measure) : ",";
        text += "\n";
    }
    return text;
}

std::vector<SweepRow> read_sweep(const SweepPlan& plan, std::span<const SweepPoint> points,
                                 const std::filesystem::path& file) {
    const std::string text = read_text(file);
    if (!text.ends_with('\n'))
        throw StorageError(fmt::format("{}: is cut short (its last line does not end): make that "
                                       "task's table again, by its call with --task",
                                       file.string()));
    const auto refuse = [&](const std::string& line) {
        throw UsageError(fmt::format("{}: is of another plan: {}", file.string(), line));
    };
    const std::string first = header(plan), found = text.substr(0, text.find('\n'));
    if (found == replaced_once(first, ",made_by", ""))
        throw UsageError(fmt::format("{}: an earlier version made it, which did not say so (it has "
                                     "no column made_by): make that task's table again, by its "
                                     "call with --task",
                                     file.string()));
    if (found != first)
        refuse(shown_start(found, 200));
    const auto all = static_cast<std::size_t>(1 + std::ranges::count(first, ','));
    const std::size_t before = 2 + plan.parameters.size();
    std::vector<SweepRow> rows;
    read_records(text, file.string(), ',', [&](const CsvRecord& record) {
        if (record.line == 1)
            return true;
        const std::vector<std::string>& cells = record.cells;
        const auto refuse_row = [&] { refuse(fmt::format("line {}", record.line)); };
        const auto number = [&](const std::string& cell) {
            const auto value = parse_number(cell);
            if (!value)
                refuse_row();
            return *value;
        };
        const auto whole = [&](const std::string& cell) {
            const double value = number(cell);
            if (std::abs(value) > 1e9 || cell != fmt::format("{:.0f}", value))
                refuse_row();
            return static_cast<int>(value);
        };
        if (cells.size() != all)
            refuse_row();
        const int run = whole(cells[0]);
        if (!(run >= 1 && static_cast<std::size_t>(run) <= points.size()))
            refuse_row();
        SweepRow row;
        row.run = static_cast<std::size_t>(run);
        row.seed = whole(cells[1]);
        for (std::size_t k = 2; k < before; ++k)
            if (cells[k] != points[row.run - 1][k - 2].text)
                refuse_row();
        row.outcome = cells[before];
        row.exit_code = static_cast<int>(std::clamp(number(cells[before + 1]), -1.0, 255.0));
        row.state_hash = cells[before + 2];
        row.made_by = cells[before + 3];
        for (std::size_t k = before + 4; k < all; ++k)
            row.measures.push_back(cells[k].empty() ? std::nullopt
                                                    : std::optional(number(cells[k])));
        rows.push_back(std::move(row));
        return true;
    });
    return rows;
}

std::vector<SweepFactor> factors_of(const SweepPlan& plan, std::span<const SweepPoint> points,
                                    std::span<const SweepRow> rows) {
    std::vector<SweepFactor> factors;
    for (std::size_t p = 0; p < plan.parameters.size(); ++p) {
        std::vector<std::string> texts; // different ones, in their order
        std::vector<double> numbers;
        for (const SweepPoint& point : points) {
            if (std::ranges::find(texts, point[p].text) == texts.end())
                texts.push_back(point[p].text);
            if (point[p].number)
                numbers.push_back(*point[p].number);
        }
        if (texts.size() < 2)
            continue;
        SweepFactor factor{plan.parameters[p].name, {}};
        const bool ordered = numbers.size() == points.size();
        const bool by_factors = ordered && go_by_factors(numbers);
        if (by_factors)
            for (double& number : numbers)
                number = dem::logarithm(number);
        const auto [least, greatest] =
            ordered ? std::ranges::minmax(numbers) : std::ranges::minmax_result<double>{0.0, 1.0};
        for (const SweepRow& row : rows) {
            const SweepValue& value = points[row.run - 1][p];
            const auto word =
                static_cast<std::size_t>(std::ranges::find(texts, value.text) - texts.begin());
            const double x = !ordered     ? static_cast<double>(word)
                             : by_factors ? dem::logarithm(*value.number)
                                          : *value.number;
            factor.place.push_back(2.0 * (x - least) / (greatest - least) - 1.0);
            if (!ordered && texts.size() > 2)
                factor.word.push_back(word);
        }
        factors.push_back(std::move(factor));
    }
    return factors;
}

} // namespace listric
