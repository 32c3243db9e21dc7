#include "apps/scene/target_csv.hpp"

#include "apps/scene/toml.hpp"
#include "apps/support/spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>

namespace listric {

using namespace dem;

namespace {

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> cells(1);
    for (char letter : line) {
        if (letter == ',')
            cells.emplace_back();
        else if (letter != ' ' && letter != '\t' && letter != '\r' && letter != '"')
            cells.back() += letter;
    }
    return cells;
}

bool is_blank(const std::string& line) {
    const auto first = line.find_first_not_of(" \t\r");
    return first == line.npos || line[first] == '#';
}

} // namespace

bool csv_has_column(const std::filesystem::path& path, std::string_view name) {
    std::ifstream file(path, std::ios::binary);
    if (!file.is_open())
        fail(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
    std::string line;
    while (std::getline(file, line) && is_blank(line)) {
    }
    if (line.starts_with("\xef\xbb\xbf"))
        line.erase(0, 3);
    const std::vector<std::string> header = cells(line);
    return std::ranges::find(header, name) != header.end();
}

std::vector<TargetStage> read_target_csv(const std::filesystem::path& path,
                                         std::string_view value_name) {
    const std::array<std::string_view, 3> names{"time_a", "x_m", value_name};
    std::ifstream file(path, std::ios::binary);
    if (!file.is_open())
        fail(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
    std::array<std::size_t, 3> column{};
    std::vector<TargetStage> stages;
    std::size_t number = 0;
    bool has_header = false;
    for (std::string line; std::getline(file, line);) {
        ++number;
        const auto refuse = [&](std::string_view what) {
            fail(fmt::format("{}:{}: {}", path.string(), number, what));
        };
        if (number == 1 && line.starts_with("\xef\xbb\xbf")) // as spreadsheets write it
            line.erase(0, 3);
        if (is_blank(line))
            continue;
        const std::vector<std::string> row = cells(line);
        if (!has_header) {
            for (std::size_t k = 0; k < names.size(); ++k) {
                column[k] =
                    static_cast<std::size_t>(std::ranges::find(row, names[k]) - row.begin());
                if (column[k] == row.size())
                    refuse(fmt::format("has no column {}, needs a header with {}; it has {}",
                                       names[k], fmt::join(names, ", "), fmt::join(row, ", ")));
            }
            has_header = true;
            continue;
        }
        std::array<double, 3> value{};
        for (std::size_t k = 0; k < names.size(); ++k) {
            const std::string cell = column[k] < row.size() ? row[column[k]] : "";
            const char* end = cell.data() + cell.size();
            const auto [stopped, error] = std::from_chars(cell.data(), end, value[k]);
            if (error != std::errc{} || stopped != end || !std::isfinite(value[k]))
                refuse(fmt::format("{}: \"{}\" is not a finite number", names[k], cell));
        }
        const auto [time, x, y] = value;
        if (time < 0.0)
            refuse(fmt::format("time_a: {} is before the start of extension, allowed: at least 0",
                               text(time)));
        if (std::abs(y) > 1e5)
            refuse(fmt::format("{}: {} is out of range, allowed: at least -1e5, at most 1e5",
                               value_name, text(y)));
        if (stages.empty() || time > stages.back().time) {
            stages.push_back({time, {}});
        } else if (time < stages.back().time) {
            refuse(
                fmt::format("time_a: {} comes after {}; sort the rows by time, those of one time "
                            "by x",
                            text(time), text(stages.back().time)));
        } else if (x <= stages.back().points.back().x) {
            refuse(fmt::format("x_m: {} comes after {} at the same time; sort the rows of one time "
                               "by x, each x once",
                               text(x), text(stages.back().points.back().x)));
        }
        stages.back().points.push_back({x, y});
    }
    if (file.bad())
        fail(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
    if (stages.empty())
        fail(fmt::format("{}: has no {}, needs {}", path.string(), has_header ? "rows" : "header",
                         fmt::join(names, ", ")));
    return stages;
}

} // namespace listric
