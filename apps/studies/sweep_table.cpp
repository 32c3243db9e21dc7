#include "apps/studies/sweep_table.hpp"

#include "apps/studies/table_cell.hpp"
#include "apps/support/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace listric {

namespace {

std::string header(const SweepPlan& plan) {
    std::string text = "run,seed";
    for (const SweepParameter& parameter : plan.parameters)
        text += "," + parameter.name;
    text += ",outcome,exit_code,state_hash";
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

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    for (std::size_t begin = 0, end; begin <= line.size(); begin = end + 1) {
        end = std::min(line.find(',', begin), line.size());
        cells.push_back(line.substr(begin, end - begin));
    }
    return cells;
}

} // namespace

std::string to_csv(const SweepPlan& plan, std::span<const SweepPoint> points,
                   std::span<const SweepRow> rows) {
    std::string text = header(plan) + "\n";
    for (const SweepRow& row : rows) {
        text += fmt::format("{},{}", row.run, row.seed);
        for (const SweepValue& value : points[row.run - 1])
            text += "," + value.text;
        text += fmt::format(",{},{},{}", cell(row.outcome), row.exit_code, row.state_hash);
        for (const std::optional<double>& measure : row.measures)
            text += measure ? fmt::format(",{}", *measure) : ",";
        text += "\n";
    }
    return text;
}

std::vector<SweepRow> read_sweep(const SweepPlan& plan, std::span<const SweepPoint> points,
                                 const std::filesystem::path& file) {
    std::ifstream in(file);
    std::string line;
    if (!std::getline(in, line))
        throw StorageError(file.string() + ": cannot be read, or is empty");
    const auto refuse = [&] {
        throw UsageError(fmt::format("{}: is of another plan: {}", file.string(), line));
    };
    if (line != header(plan))
        refuse();
    const std::size_t before = 2 + plan.parameters.size(), all = cells_of(line).size();
    std::vector<SweepRow> rows;
    while (std::getline(in, line)) {
        const std::vector<std::string> cells = cells_of(line);
        SweepRow row;
        if (cells.size() == all) {
            row.run = static_cast<std::size_t>(std::strtoull(cells[0].c_str(), nullptr, 10));
            row.seed = std::atoi(cells[1].c_str());
        }
        if (row.run < 1 || row.run > points.size())
            refuse();
        for (std::size_t k = 2; k < before; ++k)
            if (cells[k] != points[row.run - 1][k - 2].text)
                refuse();
        row.outcome = cells[before];
        row.exit_code =
            static_cast<int>(std::clamp(number_in(cells[before + 1], file), -1.0, 255.0));
        row.state_hash = cells[before + 2];
        for (std::size_t k = before + 3; k < all; ++k)
            row.measures.push_back(cells[k].empty() ? std::nullopt
                                                    : std::optional(number_in(cells[k], file)));
        rows.push_back(std::move(row));
    }
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
        const auto [least, greatest] =
            ordered ? std::ranges::minmax(numbers) : std::ranges::minmax_result<double>{0.0, 1.0};
        for (const SweepRow& row : rows) {
            const SweepValue& value = points[row.run - 1][p];
            const auto word =
                static_cast<std::size_t>(std::ranges::find(texts, value.text) - texts.begin());
            const double x = ordered ? *value.number : static_cast<double>(word);
            factor.place.push_back(2.0 * (x - least) / (greatest - least) - 1.0);
            if (!ordered && texts.size() > 2)
                factor.word.push_back(word);
        }
        factors.push_back(std::move(factor));
    }
    return factors;
}

} // namespace listric
