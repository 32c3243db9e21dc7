#pragma once

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// A piece of a drawn line: a straight line, a cubic Bezier curve, or an elliptic arc, whose points
/// are centre + cos(angle) first axis + sin(angle) second axis.
struct SvgPiece {
    enum class Kind { line, cubic, arc } kind = Kind::line;
    Eigen::Vector2d end{0.0, 0.0};    ///< it begins where the piece before ends
    Eigen::Vector2d first{0.0, 0.0};  ///< cubic: control point; arc: axis
    Eigen::Vector2d second{0.0, 0.0}; ///< likewise
    Eigen::Vector2d centre{0.0, 0.0}; ///< arc
    double begin = 0.0, turn = 0.0;   ///< arc: angles, radians
};

struct SvgPath {
    Eigen::Vector2d start{0.0, 0.0};
    std::vector<SvgPiece> pieces;
};

/// An open path's data (SVG 1.1, section 8.3): all commands. What has more than `most` pieces is
/// refused without being kept.
/// @param where  stands before what is wrong
SvgPath read_svg_path(std::string_view data, const std::string& where, std::size_t most);

/// The points of a <polyline>, of which all pieces are lines.
SvgPath read_svg_polyline(std::string_view points, const std::string& where, std::size_t most);

/// The path as points: ends of all pieces, and points between so that curves are nowhere further
/// than `flatness` from the lines that join them and neighbours no further apart than `step`. A
/// piece is given at most `most` points.
std::vector<Eigen::Vector2d> flattened(const SvgPath& path, double flatness, double step,
                                       std::size_t most);

} // namespace listric
