#include "apps/archive/tables/line_table.hpp"

#include "apps/scene/toml/json_text.hpp"
#include "apps/support/files/csv_records.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

namespace listric::archive {

namespace {

/// @param absent  in place of a number that is not finite
std::string number(double value, std::string_view absent) {
    return std::isfinite(value) ? fmt::format("{}", value + 0.0) : std::string(absent); // not -0
}

std::string word(const LineValue& value, std::string_view absent) {
    if (const auto* text = std::get_if<std::string>(&value))
        return *text;
    return number(std::get<double>(value), absent);
}

/// A word in a segment's header, which knows no escapes.
std::string gmt_word(const LineValue& value) {
    std::string text = word(value, "NaN");
    for (char& c : text)
        if (c == '"')
            c = '\'';
        else if (c == '\n' || c == '\r')
            c = ' ';
    return text;
}

/// A text of JSON.
std::string quoted(const std::string& text) { return to_text(nlohmann::json(text)); }

/// Calls visit(point, its own numbers) for each point of a line.
template <class Visit>
void for_each_point(const LineTable& table, const Line& line, Visit&& visit) {
    const std::size_t own = table.point_columns.size();
    for (std::size_t k = 0; k < line.points.size(); ++k)
        visit(line.points[k], std::span(line.at_points).subspan(k * own, own));
}

/// {"name": value, ...} with lists of the points' own numbers.
std::string properties(const LineTable& table, const Line& line) {
    std::vector<std::string> items;
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
        const auto* text = std::get_if<std::string>(&line.values[k]);
        items.push_back(fmt::format("{}: {}", quoted(table.columns[k]),
                                    text ? quoted(*text) : word(line.values[k], "null")));
    }
    items.push_back(fmt::format("\"depth_reference\": \"{}\"", depth_reference));
    for (std::size_t k = 0; k < table.point_columns.size(); ++k) {
        std::vector<std::string> numbers;
        for_each_point(table, line, [&](dem::Point, std::span<const double> own) {
            numbers.push_back(number(own[k], "null"));
        });
        items.push_back(
            fmt::format("{}: [{}]", quoted(table.point_columns[k]), fmt::join(numbers, ", ")));
    }
    return fmt::format("{{{}}}", fmt::join(items, ", "));
}

} // namespace

std::string to_csv(const LineTable& table) {
    std::string text =
        fmt::format("line,{},depth_reference,x_m,depth_m", fmt::join(table.columns, ","));
    for (const std::string& column : table.point_columns)
        text += "," + column;
    text += '\n';
    for (std::size_t n = 0; n < table.lines.size(); ++n) {
        const Line& line = table.lines[n];
        std::string head = fmt::format("{}", n);
        for (const LineValue& value : line.values)
            head += fmt::format(",{}", csv_cell(word(value, "")));
        head += fmt::format(",{}", depth_reference);
        for_each_point(table, line, [&](dem::Point p, std::span<const double> own) {
            text += fmt::format("{},{},{}", head, number(p.x, ""), number(-p.y, ""));
            for (const double value : own)
                text += fmt::format(",{}", number(value, ""));
            text += '\n';
        });
    }
    return text;
}

std::string to_geojson(const LineTable& table) {
    std::vector<std::string> features;
    for (const Line& line : table.lines) {
        std::vector<std::string> places;
        for (const dem::Point p : line.points)
            places.push_back(fmt::format("[{}, {}]", number(p.x, "null"), number(p.y, "null")));
        // A LineString has two positions or more (RFC 7946, 3.1.4).
        const bool is_point = places.size() == 1;
        const std::string list = fmt::format("{}", fmt::join(places, ", "));
        features.push_back(
            fmt::format("{{\"type\": \"Feature\", \"properties\": {},\n \"geometry\": {{\"type\": "
                        "\"{}\", \"coordinates\": {}}}}}",
                        properties(table, line), is_point ? "Point" : "LineString",
                        is_point ? list : fmt::format("[{}]", list)));
    }
    const std::string place =
        fmt::format("x: m from the breakaway into the hanging wall; y: m above the {} (y = 0), "
                    "below it negative; columns of depth are positive down from there",
                    depth_reference);
    return fmt::format("{{\"type\": \"FeatureCollection\", \"name\": {}, \"description\": {}, "
                       "\"features\": [\n{}\n]}}\n",
                       quoted(table.name), quoted(place), fmt::join(features, ",\n"));
}

std::string to_gmt(const LineTable& table) {
    std::string text = "# x_m depth_m";
    for (const std::string& column : table.point_columns)
        text += fmt::format(" {}", column);
    text +=
        fmt::format("\n# x_m: m from the breakaway; depth_m: m below the {} (depth 0), above it "
                    "negative\n",
                    depth_reference);
    for (const Line& line : table.lines) {
        std::string level, words;
        for (std::size_t k = 1; k < table.columns.size(); ++k) {
            const std::string value = gmt_word(line.values[k]);
            if (table.columns[k] == table.level)
                level = fmt::format(" -Z{}", value);
            words += fmt::format(" {}={}", table.columns[k], value);
        }
        text += fmt::format(">{} -L\"{}\"{}\n", level, gmt_word(line.values.front()), words);
        for_each_point(table, line, [&](dem::Point p, std::span<const double> own) {
            text += fmt::format("{}\t{}", number(p.x, "NaN"), number(-p.y, "NaN"));
            for (const double value : own)
                text += fmt::format("\t{}", number(value, "NaN"));
            text += '\n';
        });
    }
    return text;
}

std::string to_gocad(const LineTable& table) {
    std::string text;
    for (const Line& line : table.lines) {
        std::string name = gmt_word(line.values.front());
        std::ranges::replace(name, ' ', '_');
        text += fmt::format("GOCAD PLine 1\nHEADER {{\nname: {}\n}}\n"
                            "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME section\nAXIS_NAME \"X\" \"Y\" "
                            "\"Z\"\nAXIS_UNIT \"m\" \"m\" \"m\"\nZPOSITIVE Elevation\n"
                            "END_ORIGINAL_COORDINATE_SYSTEM\nILINE\n",
                            name);
        for (std::size_t k = 0; k < line.points.size(); ++k)
            text += fmt::format("VRTX {} {} 0 {}\n", k + 1, number(line.points[k].x, "0"),
                                number(line.points[k].y, "0"));
        for (std::size_t k = 1; k < line.points.size(); ++k)
            text += fmt::format("SEG {} {}\n", k, k + 1);
        text += "END\n";
    }
    return text;
}

std::string to_gempy(const LineTable& table) {
    constexpr double degree = dem::pi / 180.0;
    std::string text = "X,Y,Z,surface,dip,azimuth,polarity\n";
    for (const Line& line : table.lines)
        for (std::size_t k = 0; line.points.size() > 1 && k < line.points.size(); ++k) {
            const dem::Point a = line.points[k == 0 ? 0 : k - 1];
            const dem::Point b = line.points[std::min(k + 1, line.points.size() - 1)];
            const double right = std::abs(b.x - a.x), down = (b.x < a.x ? b.y - a.y : a.y - b.y);
            text += fmt::format(
                "{},0,{},{},{:.2f},{},1\n", number(line.points[k].x, ""),
                number(line.points[k].y, ""), csv_cell(word(line.values.front(), "")),
                dem::arc_tangent(std::abs(down), right) / degree, down < 0.0 ? 270 : 90);
        }
    return text;
}

} // namespace listric::archive
