#include "apps/scene/picks/picked_fault.hpp"

#include "apps/scene/coordinates.hpp"
#include "apps/scene/picks/fault_fit.hpp"
#include "apps/scene/picks/kept_fit.hpp"
#include "apps/scene/svg/fault_svg.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/csv.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/words/spelling.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace listric {

using namespace dem;

namespace {

constexpr std::size_t fewest_points = 3, most_points = 20'000;
constexpr double sharp_turn = 20.0; ///< degrees
constexpr double wide_gap = 4.0;    ///< median distances of neighbours

FaultPoints read_csv_points(const FaultSource& source, const std::filesystem::path& file) {
    const CsvRows rows = read_csv(file, {.numbers = {"x_m", "depth_m"},
                                         .labels = {"name", "line", "segment"},
                                         .delimiter = source.csv_delimiter});
    require_one_line(rows, file, "a detachment");
    FaultPoints fault;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        fault.points.push_back({rows.columns[0][k], -rows.columns[1][k]});
        fault.where.push_back(csv_place(file.string(), rows.line[k]));
    }
    return fault;
}

/// "file:line" of a point, or where it is in its drawing.
std::string place_of(const FaultPoints& fault, std::size_t k) {
    if (fault.drawing_points.empty())
        return fault.where[k];
    const Point p = fault.drawing_points[k];
    return fmt::format("{}, at ({:.6g}, {:.6g}) of svg_points", fault.where[0], p.x, p.y);
}

void check_order(const FaultPoints& fault, double tolerance) {
    const std::vector<Point>& p = fault.points;
    if (p.back().x < p.front().x)
        refuse(place_of(fault, fault.points.size() - 1),
               p.back().y < p.front().y
                   ? "x_m falls down the fault, which must dip toward greater x; change the sign "
                     "of x_m"
                   : "the points begin at the deep end; turn their order round");
    std::size_t furthest = 0, deepest = 0;
    for (std::size_t k = 1; k < p.size(); ++k) {
        if (p[k].x < p[furthest].x - tolerance)
            refuse(place_of(fault, k),
                   fmt::format("x_m goes back by {:.0f} m, allowed: at most tolerance_m = {}; the "
                               "points must follow the fault from the breakaway down, which may "
                               "not fold back or cross itself",
                               p[furthest].x - p[k].x, text(tolerance)));
        if (p[k].y > p[deepest].y + tolerance)
            refuse(place_of(fault, k),
                   fmt::format("the fault rises by {:.0f} m, allowed: at most tolerance_m = {}; a "
                               "detachment descends and ends flat",
                               p[k].y - p[deepest].y, text(tolerance)));
        furthest = p[k].x > p[furthest].x ? k : furthest;
        deepest = p[k].y < p[deepest].y ? k : deepest;
    }
}

void check_breakaway(const FaultPoints& fault, double tolerance) {
    const Point first = fault.points.front();
    if (std::abs(first.x) > tolerance)
        refuse(place_of(fault, 0),
               fmt::format("begins at x = {} m, but the breakaway is at x = 0; give "
                           "detachment.shift_x_m = {}, more by that than now",
                           to_millimetres(first.x), to_millimetres(-first.x)));
    if (std::abs(first.y) > tolerance)
        refuse(place_of(fault, 0),
               fmt::format("begins at a depth of {} m, but the breakaway is at the original "
                           "surface; add the point of depth 0 before it",
                           to_millimetres(-first.y)));
}

/// Angle between two directions, radians.
double angle_between(Point a, Point b) {
    return std::abs(dem::arc_tangent(cross(a, b), dot(a, b)));
}

/// How far the fault may be from what is fitted between two points: half the height of the triangle
/// whose sides go on as the fault comes to the first and leaves the last. The directions are taken
/// over several lengths, and what is least counts: single steps have noise in them, long ones what
/// the fault does beyond the gap.
double uncertainty(const std::vector<Point>& p, std::size_t k) {
    const Point gap = p[k + 1] - p[k];
    const double length = norm(gap);
    double least = length;
    for (double share : {0.0, 0.03125, 0.0625, 0.125, 0.25, 0.5}) {
        std::size_t before = k - 1, after = k + 2;
        while (before > 0 && norm(p[k] - p[before]) < share * length)
            --before;
        while (after + 1 < p.size() && norm(p[after] - p[k + 1]) < share * length)
            ++after;
        const double a = angle_between(p[k] - p[before], gap);
        const double b = angle_between(gap, p[after] - p[k + 1]);
        const double flatter = std::min({a, b, 0.25 * pi}), steeper = std::min(std::max(a, b), 1.5);
        const double height =
            flatter > 0.0 ? length / (1.0 / dem::tangent(flatter) + 1.0 / dem::tangent(steeper))
                          : 0.0;
        least = std::min(least, 0.5 * height);
    }
    return least;
}

/// No wide gap in which the fault turns so much that its place would be a guess.
void check_gaps(const FaultPoints& fault, double tolerance) {
    const std::vector<Point>& p = fault.points;
    std::vector<double> steps;
    for (std::size_t k = 0; k + 1 < p.size(); ++k)
        steps.push_back(norm(p[k + 1] - p[k]));
    std::vector<double> sorted = steps;
    std::ranges::nth_element(sorted, sorted.begin() + std::ssize(sorted) / 2);
    const double usual = sorted[sorted.size() / 2];
    for (std::size_t k = 1; k + 1 < steps.size(); ++k) {
        if (steps[k] <= wide_gap * usual)
            continue;
        if (const double off = uncertainty(p, k); off > tolerance)
            refuse(
                place_of(fault, k + 1),
                fmt::format("after a gap of {:.0f} m in which the fault turns, so that it may be "
                            "{:.0f} m from what is fitted, allowed: tolerance_m = {}; add points "
                            "there, as near as the others ({:.0f} m)",
                            steps[k], off, text(tolerance), usual));
    }
}

/// A detachment leads down.
void check_descent(const FaultPoints& fault, double tolerance) {
    const auto deepest = std::ranges::min_element(fault.points, {}, &Point::y);
    if (-deepest->y <= tolerance)
        refuse(place_of(fault, fault.points.size() - 1),
               fmt::format("the fault is flat: it is nowhere deeper than {} m, needed: more than "
                           "tolerance_m = {}; are depths in metres?",
                           to_millimetres(std::max(0.0, -deepest->y)), text(tolerance)));
}

void check_points(const FaultPoints& fault, double tolerance) {
    constexpr double far = 1e6, deep = 1e5; // m
    const std::size_t count = fault.points.size();
    if (count < fewest_points)
        refuse(place_of(fault, fault.points.size() - 1),
               fmt::format("has {} point{}, needs at least {}", count, count == 1 ? "" : "s",
                           fewest_points));
    if (count > most_points)
        refuse(place_of(fault, fault.points.size() - 1),
               fmt::format("has {} points, allowed: at most {}; keep every {}", count, most_points,
                           ordinal(1 + (count - 1) / most_points)));
    for (std::size_t k = 0; k < count; ++k) {
        const Point p = fault.points[k];
        if (!std::isfinite(p.x) || !std::isfinite(p.y))
            refuse(place_of(fault, k), "has coordinates that are not finite");
        if (p.y > tolerance)
            refuse(place_of(fault, k),
                   fmt::format("depth_m: {} is above the original surface; depth "
                               "is positive down",
                               to_millimetres(-p.y)));
        if (-p.y > deep || std::abs(p.x) > far)
            refuse(place_of(fault, k),
                   fmt::format("x_m = {}, depth_m = {} is out of range, allowed: x_m -1e6 to 1e6, "
                               "depth_m to 1e5; is it in metres? From map "
                               "coordinates detachment.shift_x_m leads to the breakaway",
                               to_millimetres(p.x), to_millimetres(-p.y)));
    }
    check_order(fault, tolerance);
    check_breakaway(fault, tolerance);
    check_descent(fault, tolerance);
    if (!fault.drawn) // a straight piece of a drawing is no gap
        check_gaps(fault, tolerance);
}

} // namespace

FaultPoints read_fault(const FaultSource& source, const std::filesystem::path& file) {
    FaultPoints fault =
        source.svg.empty() ? read_csv_points(source, file) : read_fault_svg(source, file);
    for (Point& p : fault.points)
        p.x += source.shift_x;
    return fault;
}

PickedFault fit_detachment(DetachmentParameters& detachment, const FaultPoints& fault,
                           double tolerance) {
    check_points(fault, tolerance);
    const FaultFit fit = fit_or_recall_fault(fault.points, tolerance);
    if (!fit.flat)
        refuse(place_of(fault, fault.points.size() - 1),
               fmt::format("ends with a dip of {:.1f} degrees, but a detachment ends flat (within "
                           "tolerance_m = {}); add points down to where it is flat",
                           fit.end_dip, text(tolerance)));
    if (fit.misfit > tolerance)
        refuse(place_of(fault, fit.worst),
               fmt::format("is {:.0f} m off the arcs and lines that fit best, allowed: tolerance_m "
                           "= {}; correct the point or allow more",
                           fit.misfit, text(tolerance)));
    detachment.start_dip = fit.start_dip;
    detachment.segments = fit.segments;
    PickedFault picked;
    for (const Point& p : fault.points) {
        picked.x.push_back(p.x);
        picked.depth.push_back(-p.y);
    }
    picked.misfit = fit.misfit;
    picked.drawn = fault.drawn ? std::optional(fault.place) : std::nullopt;
    return picked;
}

std::string describe(const PickedFault& picked, const DetachmentParameters& detachment) {
    const Chain chain = detachment_chain(detachment, 0.0);
    const auto distance = [&](std::size_t k) {
        return distance_from(chain, {picked.x[k], -picked.depth[k]});
    };
    double square = 0.0, largest = -1.0;
    std::size_t worst = 0;
    for (std::size_t k = 0; k < picked.x.size(); ++k) {
        square += distance(k) * distance(k);
        if (distance(k) > largest) {
            largest = distance(k);
            worst = k;
        }
    }
    std::string line =
        fmt::format("detachment: {} arcs and lines through {} points, at most {:.1f} m off",
                    detachment.segments.size(), picked.x.size(), picked.misfit);
    if (!picked.x.empty())
        line += fmt::format(" (at x = {:.0f} m), {:.1f} m in the root mean square", picked.x[worst],
                            std::sqrt(square / static_cast<double>(picked.x.size())));
    if (picked.drawn)
        line += fmt::format("; svg_points are at most {:.1f} m off, depths drawn {:.3g} times as "
                            "large as lengths",
                            picked.drawn->misfit, picked.drawn->exaggeration);
    return line;
}

std::string too_sharp(const DetachmentParameters& detachment, double mean_radius) {
    double dip = detachment.start_dip;
    for (const DetachmentSegment& segment : detachment.segments) {
        if (segment.kind != DetachmentSegment::Kind::arc)
            continue;
        if (std::abs(segment.end_dip - dip) > sharp_turn && segment.radius < mean_radius)
            return fmt::format("turns from a dip of {:.0f} to one of {:.0f} degrees with a radius "
                               "of {:.0f} m, more sharply than discs of a mean radius of {} m can "
                               "follow; allow more tolerance_m, or take smaller discs",
                               dip, segment.end_dip, segment.radius, text(mean_radius));
        dip = segment.end_dip;
    }
    return "";
}

} // namespace listric
