#pragma once

#include "dem/numbers/point.hpp"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace listric::archive {

/// A word or a number; not finite: none.
using LineValue = std::variant<std::string, double>;

/// A line, or points that belong together, of a section.
struct Line {
    std::vector<LineValue> values;       ///< by LineTable::columns
    std::vector<dem::Point> points = {}; ///< m, y up
    std::vector<double> at_points = {};  ///< point by point the LineTable::point_columns
};

/// Lines that are written as one file. Files have depth, positive down.
struct LineTable {
    std::string name;                            ///< of the file
    std::string level;                           ///< the column that is the lines' Z in a GMT file
    std::vector<std::string> columns;            ///< of a line; the first is its name
    std::vector<std::string> point_columns = {}; ///< of a point, besides x_m and depth_m
    std::vector<Line> lines = {};
};

/// The level at which y and every depth are 0, as files say it in a column, member or comment of
/// this name: they travel without their documents.
inline constexpr std::string_view depth_reference = "original surface";

// Numbers are the shortest that read back the same, and equal in all formats. A number that there
// is not is an empty field of CSV, null of GeoJSON and NaN of GMT.

/// A row per point: the line's number, its values, depth_reference, x_m, depth_m and the point's
/// own.
std::string to_csv(const LineTable& table);

/// A collection of line strings with coordinates [x, -depth], so that maps show them upright, and a
/// description of these, which GDAL reads.
std::string to_geojson(const LineTable& table);

/// A segment per line: a header with -Z, -L and its values as NAME=VALUE, then rows of x, depth and
/// the point's own.
std::string to_gmt(const LineTable& table);

/// GOCAD polylines (ASCII .pl), an ILINE per line under its name: x, 0, height above the original
/// surface.
std::string to_gocad(const LineTable& table);

/// Points of lines as models of implicit surfaces read them: X, Y = 0, Z up, surface, and the dip,
/// azimuth (90: to the right) and polarity of the line there.
std::string to_gempy(const LineTable& table);

} // namespace listric::archive
