#include "apps/scene/svg/fault_svg.hpp"

#include "apps/scene/svg/svg_element.hpp"
#include "apps/scene/svg/svg_path.hpp"
#include "apps/scene/svg/svg_place.hpp"
#include "apps/scene/svg/svg_transform.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/reading.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace listric {

using namespace dem;

namespace {

using Eigen::Vector2d;
using ReferencePoints = std::vector<std::array<double, 4>>;

constexpr std::size_t most_nodes = 20'000;
constexpr double flatness = 0.05; ///< of the tolerance: how far a curve may be from its points
constexpr double steps_of_a_path = 60.0; ///< at least: the fit must see straight lines, too
constexpr double least_share = 0.01;     ///< of the path's size that svg_points must span

void load(pugi::xml_document& document, const std::filesystem::path& file) {
    constexpr std::uintmax_t largest = 1'000'000'000; // bytes
    std::error_code error;
    const std::string where = shown(file.string());
    if (const auto size = std::filesystem::file_size(file, error); !error && size > largest)
        refuse(where,
               fmt::format("has {} bytes, allowed for a drawing: at most {}", size, largest));
    const std::optional<std::string> text = first_bytes(file, largest);
    if (text && text->starts_with("\x1f\x8b"))
        refuse(where, "is compressed (.svgz); save it as plain SVG");
    pugi::xml_parse_result parsed;
    parsed.status = pugi::status_file_not_found;
    if (text)
        parsed = document.load_buffer(text->data(), text->size());
    if (!parsed)
        refuse(where, fmt::format("cannot be read as SVG: {} at byte {}", parsed.description(),
                                  parsed.offset));
}

SvgPath path_of(pugi::xml_node line, const std::string& where) {
    const std::string_view kind = svg_name(line);
    const auto attribute = [&](const char* key) {
        const std::string_view text = line.attribute(key).value();
        if (text.find('&') != text.npos)
            refuse(where, fmt::format("{} has an entity, {}, which is not read", key,
                                      shown(text.substr(text.find('&'), 20))));
        return text;
    };
    if (kind == "path")
        return read_svg_path(attribute("d"), where, most_nodes - 1);
    if (kind == "polyline")
        return read_svg_polyline(attribute("points"), where, most_nodes - 1);
    const auto place = [&](const char* key) {
        const std::string_view text = attribute(key);
        return text.empty() ? 0.0 : svg_length(text, std::nullopt, where);
    };
    return {{place("x1"), place("y1")}, {{.end = {place("x2"), place("y2")}}}};
}

/// In coordinates to which an affine transformation leads.
SvgPath moved(SvgPath path, const Eigen::Affine2d& to) {
    path.start = to * path.start;
    for (SvgPiece& piece : path.pieces) {
        const bool is_arc = piece.kind == SvgPiece::Kind::arc; // its axes are no places
        const auto place_or_axis = [&](const Vector2d& p) {
            return is_arc ? Vector2d(to.linear() * p) : Vector2d(to * p);
        };
        piece.end = to * piece.end;
        piece.first = place_or_axis(piece.first);
        piece.second = place_or_axis(piece.second);
        piece.centre = to * piece.centre;
    }
    return path;
}

bool is_finite(const SvgPath& path) {
    return path.start.allFinite() && std::ranges::all_of(path.pieces, [](const SvgPiece& p) {
               return p.end.allFinite() && p.first.allFinite() && p.second.allFinite() &&
                      p.centre.allFinite() && std::isfinite(p.begin) && std::isfinite(p.turn);
           });
}

struct Extents {
    Vector2d low, high;
    Vector2d size() const { return high - low; }
};

/// Extents of the ends of a path's pieces.
Extents extents_of(const SvgPath& path) {
    Extents e{path.start, path.start};
    for (const SvgPiece& piece : path.pieces) {
        e.low = e.low.cwiseMin(piece.end);
        e.high = e.high.cwiseMax(piece.end);
    }
    return e;
}

/// Metres along one direction by drawing units: value = offset + scale * units.
struct Scale {
    double offset = 0.0, scale = 0.0;
    double operator()(double units) const { return offset + scale * units; }
};

/// Least squares through the reference points.
/// @param extent  of the path in this direction, units
Scale scale_of(const ReferencePoints& points, std::size_t from, std::size_t to,
               const char* direction, double extent, const std::string& where) {
    double mean_from = 0.0, mean_to = 0.0, square = 0.0, product = 0.0;
    const auto count = static_cast<double>(points.size());
    for (const auto& p : points) {
        mean_from += p[from] / count;
        mean_to += p[to] / count;
    }
    for (const auto& p : points) {
        square += (p[from] - mean_from) * (p[from] - mean_from);
        product += (p[from] - mean_from) * (p[to] - mean_to);
    }
    if (points.size() < 2 || !(square > 0.0) || product == 0.0)
        refuse(where, fmt::format("svg_points must have two points that differ {}, "
                                  "[[px, py, x_m, depth_m], ...]",
                                  direction));
    const auto [low, high] =
        std::ranges::minmax(points, {}, [from](const std::array<double, 4>& p) { return p[from]; });
    if (high[from] - low[from] < least_share * extent)
        refuse(where, fmt::format("svg_points are within {} units {}, of {:.0f} that the path has; "
                                  "take points further apart",
                                  text(high[from] - low[from]), direction, extent));
    const double scale = product / square;
    return {mean_to - scale * mean_from, scale};
}

/// The places of reference points agree as far as the fault need be known.
double check_agreement(const ReferencePoints& points, Scale x, Scale depth, double tolerance,
                       const std::string& where) {
    double largest = 0.0;
    std::size_t worst = 0;
    const auto off = [&](std::size_t k) {
        const auto& p = points[k];
        return Point{x(p[0]) - p[2], depth(p[1]) - p[3]};
    };
    for (std::size_t k = 0; k < points.size(); ++k)
        if (const double distance = norm(off(k)); distance > largest) {
            largest = distance;
            worst = k;
        }
    if (!(largest <= tolerance))
        refuse(where,
               fmt::format("svg_points do not agree: the {} is {:.0f} m off ({:.0f} m across, "
                           "{:.0f} m in depth) where all are placed as well as can be, allowed: "
                           "tolerance_m = {}; correct the one that is wrong",
                           ordinal(worst + 1), largest, std::abs(off(worst).x),
                           std::abs(off(worst).y), text(tolerance)));
    return largest;
}

/// Points with sharp corners made round by as much as the tolerance lets them: what is drawn with a
/// ruler is not meant to be a kink that no disc can follow.
/// @param off  largest distance from the corner, m
std::vector<Vector2d> rounded(const std::vector<Vector2d>& points, double off) {
    constexpr double sharp = 15.0 * pi / 180.0, reversed = 170.0 * pi / 180.0;
    constexpr int steps = 4;
    std::vector<Vector2d> round;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vector2d in = k > 0 ? Vector2d(points[k] - points[k - 1]) : Vector2d(0.0, 0.0);
        const Vector2d out =
            k + 1 < points.size() ? Vector2d(points[k + 1] - points[k]) : Vector2d(0.0, 0.0);
        const double turn =
            std::abs(dem::arc_tangent(in.x() * out.y() - in.y() * out.x(), in.dot(out)));
        if (in.norm() == 0.0 || out.norm() == 0.0 || turn < sharp || turn > reversed) {
            round.push_back(points[k]);
            continue;
        }
        const double radius = off / (1.0 / dem::cosine(0.5 * turn) - 1.0);
        const double reach =
            std::min({radius * dem::tangent(0.5 * turn), 0.5 * in.norm(), 0.5 * out.norm()});
        const Vector2d begin = points[k] - reach * in.normalized();
        const Vector2d centre_way = (out.normalized() - in.normalized()).normalized();
        const Vector2d centre = points[k] + reach / dem::sine(0.5 * turn) * centre_way;
        const double way = in.x() * out.y() - in.y() * out.x() > 0.0 ? 1.0 : -1.0;
        for (int j = 0; j <= steps; ++j)
            round.push_back(centre + Eigen::Rotation2Dd(way * turn * j / steps) * (begin - centre));
    }
    return round;
}

} // namespace

FaultPoints read_fault_svg(const FaultSource& source, const std::filesystem::path& file) {
    pugi::xml_document document;
    load(document, file);
    const std::string name = shown(file.string());
    const pugi::xml_node line = find_svg_line(document, source.svg_path, name);
    const std::string where =
        fmt::format("{}: {} {}", name, svg_name(line), shown(source.svg_path));
    const SvgPath drawn = moved(path_of(line, where), place_in_drawing(line, where));
    if (!is_finite(drawn))
        refuse(where, "has coordinates that are not finite");
    const Extents extents = extents_of(drawn);
    if (!(extents.size().norm() > 0.0))
        refuse(where, "has all its points at one place");
    const ReferencePoints& references = source.svg_points;
    const Scale x = scale_of(references, 0, 2, "across", extents.size().x(), where);
    const Scale depth = scale_of(references, 1, 3, "in depth", extents.size().y(), where);
    FaultPoints fault;
    fault.drawn = true;
    fault.where = {where};
    fault.place = {check_agreement(references, x, depth, source.tolerance, where),
                   std::abs(depth.scale) > 0.0 ? std::abs(x.scale / depth.scale) : 1.0};
    Eigen::Affine2d section = Eigen::Affine2d::Identity();
    section.matrix() << x.scale, 0.0, x.offset, 0.0, depth.scale, depth.offset, 0.0, 0.0, 1.0;
    const SvgPath in_section = moved(drawn, section);
    if (!is_finite(in_section))
        refuse(where, "has coordinates that are not finite");
    const double step = extents_of(in_section).size().norm() / steps_of_a_path;
    const std::size_t most = std::max<std::size_t>(1, most_nodes / in_section.pieces.size() - 1);
    const std::vector<Vector2d> points =
        flattened(in_section, flatness * source.tolerance, step, most);
    for (const Vector2d& p : rounded(points, 0.25 * source.tolerance)) {
        fault.points.push_back({p.x(), -p.y()});
        fault.drawing_points.push_back(
            {(p.x() - x.offset) / x.scale, (p.y() - depth.offset) / depth.scale});
    }
    return fault;
}

} // namespace listric
