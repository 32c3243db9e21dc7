#include "apps/scene/picks/observed.hpp"

#include "apps/support/error.hpp"
#include "apps/support/files/csv.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace listric {

namespace {

/// Piece of every row, among those of its name: the labels that the file has, else the number of
/// its block, by empty lines. Empty lines between all rows are a way to write, and part nothing.
std::vector<std::string> pieces_of(const CsvRows& rows) {
    if (std::ranges::any_of(rows.label, [](const std::string& label) { return !label.empty(); }))
        return rows.label;
    const bool is_spaced = std::count(rows.after_gap.begin(), rows.after_gap.end(), true) + 1 >=
                           std::ssize(rows.after_gap);
    std::vector<std::string> pieces;
    int block = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        block += k > 0 && rows.after_gap[k] && !is_spaced;
        pieces.push_back(std::to_string(block));
    }
    return pieces;
}

/// Largest coordinate of a section of the Earth: nobody means more, m.
constexpr double furthest = 1e8;

} // namespace

std::string objection_to_corners(const std::vector<double>& c) {
    if (c.size() != 4)
        return c.empty() ? "are missing" : fmt::format("{} numbers", c.size());
    for (const double value : c)
        if (!(std::abs(value) <= furthest))
            return fmt::format("{:g} is no place in a section", value);
    const auto is_above = [](double low, double high) {
        return high - low > 1e-6 * std::max(std::abs(low), std::abs(high));
    };
    if (!is_above(c[0], c[2]))
        return fmt::format("x1 = {:g} must be greater than x0 = {:g}", c[2], c[0]);
    if (!is_above(c[1], c[3]))
        return fmt::format("z1 = {:g} must be greater than z0 = {:g}{}", c[3], c[1],
                           c[3] < 0.0 ? ", these are heights" : "");
    return {};
}

PickedFile read_picked_lines(const std::filesystem::path& path, double shift) {
    const CsvRows rows = read_csv(path, {.words = "name",
                                         .numbers = {"x_m", "depth_m"},
                                         .optional = {"age_a"},
                                         .labels = {"line", "segment"}});
    PickedFile picked{path.string(), {}, {}};
    const std::vector<std::string> pieces = pieces_of(rows);
    std::map<std::pair<std::string, std::string>, std::size_t> places;
    std::map<std::string, double> ages;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::string& name = rows.words[k];
        const double x = rows.columns[0][k], depth = rows.columns[1][k], age = rows.columns[2][k];
        const auto refuse = [&](const std::string& what) {
            throw SceneError(fmt::format("{}: {}", csv_place(picked.file, rows.line[k]), what));
        };
        if (name.empty())
            refuse("has no name");
        if (std::abs(x) > 1e7 || std::abs(depth) > 1e5)
            refuse(fmt::format("x_m = {}, depth_m = {} is out of range, allowed: x_m -1e7 to 1e7, "
                               "depth_m -1e5 to 1e5; is it in metres?",
                               text(x), text(depth)));
        const auto [place, is_new] = places.try_emplace({name, pieces[k]}, picked.lines.size());
        if (is_new) {
            picked.lines.push_back({name, std::nullopt, {}, {}});
            picked.rows.emplace_back();
        }
        PickedLine& line = picked.lines[place->second];
        if (age < 0.0)
            refuse(fmt::format("age_a: {} is after the end of extension, allowed: at least 0",
                               text(age)));
        if (!std::isnan(age))
            if (const double known = ages.try_emplace(name, age).first->second; known != age)
                refuse(fmt::format("age_a: {} has {} above and {} here; a horizon has one age",
                                   shown_start(name), text(known), text(age)));
        line.x.push_back(x + shift);
        line.depth.push_back(depth);
        picked.rows[place->second].push_back(rows.line[k]);
    }
    for (PickedLine& line : picked.lines)
        if (const auto age = ages.find(line.name); age != ages.end())
            line.age = age->second;
    return picked;
}

} // namespace listric
