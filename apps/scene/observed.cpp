#include "apps/scene/observed.hpp"

#include "apps/support/csv.hpp"
#include "apps/support/error.hpp"
#include "apps/support/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace listric {

std::vector<PickedLine> read_picked_lines(const std::filesystem::path& file) {
    std::vector<std::string_view> columns{"x_m", "depth_m"};
    const bool dated = csv_has_column(file, "age_a");
    if (dated)
        columns.push_back("age_a");
    const std::vector<std::string> names = read_csv_words(file, "name");
    const CsvRows rows = read_csv(file, columns);
    std::vector<PickedLine> lines;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto refuse = [&](const std::string& what) {
            throw SceneError(fmt::format("{}:{}: {}", file.string(), rows.line[k], what));
        };
        const double x = rows.columns[0][k], depth = rows.columns[1][k];
        if (names[k].empty())
            refuse("has no name");
        if (std::abs(x) > 1e7 || std::abs(depth) > 1e5)
            refuse(fmt::format("x_m = {}, depth_m = {} is out of range, allowed: x_m -1e7 to 1e7, "
                               "depth_m -1e5 to 1e5; is it in metres?",
                               text(x), text(depth)));
        auto line = std::ranges::find(lines, names[k], &PickedLine::name);
        if (line == lines.end())
            line = lines.insert(line, {names[k], std::nullopt, {}, {}});
        if (dated) {
            const double age = rows.columns[2][k];
            if (age < 0.0)
                refuse(fmt::format("age_a: {} is after the end of extension, allowed: at least 0",
                                   text(age)));
            if (line->age && *line->age != age)
                refuse(fmt::format("age_a: {} has {} above and {} here; a horizon has one age",
                                   names[k], text(*line->age), text(age)));
            line->age = age;
        }
        line->x.push_back(x);
        line->depth.push_back(depth);
    }
    return lines;
}

} // namespace listric
