#include "apps/scene/picked_fault.hpp"

#include "apps/scene/fault_fit.hpp"
#include "apps/scene/fault_svg.hpp"
#include "apps/support/csv.hpp"
#include "apps/support/csv_records.hpp"
#include "apps/support/error.hpp"
#include "apps/support/spelling.hpp"
#include "dem/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace listric {

using namespace dem;

namespace {

constexpr std::size_t fewest_points = 3, most_points = 20'000;
constexpr double sharp_turn = 20.0; ///< degrees
constexpr double gap_turn = 10.0;   ///< degrees
constexpr double wide_gap = 4.0;    ///< median distances of neighbours

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
    throw SceneError(fmt::format("{}: {}", where, what));
}

FaultPoints read_csv_points(const FaultSource& source, const std::filesystem::path& file) {
    const CsvRows rows =
        read_csv(file, {.numbers = {"x_m", "depth_m"}, .delimiter = source.csv_delimiter});
    FaultPoints fault;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        fault.points.push_back({rows.columns[0][k], -rows.columns[1][k]});
        fault.where.push_back(csv_place(file.string(), rows.line[k]));
    }
    return fault;
}

/// Dip of the line from a point to the next, degrees.
double dip_after(const std::vector<Point>& p, std::size_t k) {
    return std::atan2(p[k].y - p[k + 1].y, p[k + 1].x - p[k].x) * 180.0 / pi;
}

void check_order(const FaultPoints& fault, double tolerance) {
    const std::vector<Point>& p = fault.points;
    if (p.back().x < p.front().x)
        refuse(fault.where.back(),
               p.back().y < p.front().y
                   ? "x_m falls down the fault, which must dip toward greater x; change the sign "
                     "of x_m"
                   : "the points begin at the deep end; turn their order round");
    std::size_t furthest = 0, deepest = 0;
    for (std::size_t k = 1; k < p.size(); ++k) {
        if (p[k].x < p[furthest].x - tolerance)
            refuse(fault.where[k],
                   fmt::format("x_m goes back by {:.0f} m, allowed: at most tolerance_m = {}; the "
                               "points must follow the fault from the breakaway down, which may "
                               "not fold back or cross itself",
                               p[furthest].x - p[k].x, text(tolerance)));
        if (p[k].y > p[deepest].y + tolerance)
            refuse(fault.where[k],
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
        refuse(fault.where.front(),
               fmt::format("begins at x = {} m, but the breakaway is at x = 0; give "
                           "detachment.shift_x_m = {}, more by that than now",
                           text(first.x), text(-first.x)));
    if (std::abs(first.y) > tolerance)
        refuse(fault.where.front(),
               fmt::format("begins at a depth of {} m, but the breakaway is at the original "
                           "surface; add the point of depth 0 before it",
                           text(-first.y)));
}

/// No wide gap where the fault turns: what it does there would be a guess.
void check_gaps(const FaultPoints& fault) {
    const std::vector<Point>& p = fault.points;
    std::vector<double> steps;
    for (std::size_t k = 0; k + 1 < p.size(); ++k)
        steps.push_back(norm(p[k + 1] - p[k]));
    std::vector<double> sorted = steps;
    std::ranges::nth_element(sorted, sorted.begin() + std::ssize(sorted) / 2);
    const double usual = sorted[sorted.size() / 2];
    for (std::size_t k = 1; k + 1 < steps.size(); ++k) {
        const double turn = std::abs(dip_after(p, k - 1) - dip_after(p, k + 1));
        if (steps[k] > wide_gap * usual && turn > gap_turn)
            refuse(
                fault.where[k + 1],
                fmt::format("after a gap of {:.0f} m in which the fault turns by {:.0f} degrees; "
                            "add points there, as near as the others ({:.0f} m)",
                            steps[k], turn, usual));
    }
}

void check_points(const FaultPoints& fault, double tolerance) {
    constexpr double far = 1e6, deep = 1e5; // m
    const std::size_t count = fault.points.size();
    if (count < fewest_points)
        refuse(fault.where.back(), fmt::format("has {} point{}, needs at least {}", count,
                                               count == 1 ? "" : "s", fewest_points));
    if (count > most_points)
        refuse(fault.where.back(),
               fmt::format("has {} points, allowed: at most {}; keep every {}th", count,
                           most_points, 1 + count / most_points));
    for (std::size_t k = 0; k < count; ++k) {
        const Point p = fault.points[k];
        if (p.y > tolerance)
            refuse(fault.where[k], fmt::format("depth_m: {} is above the original surface; depth "
                                               "is positive down",
                                               text(-p.y)));
        if (-p.y > deep || std::abs(p.x) > far)
            refuse(fault.where[k],
                   fmt::format("x_m = {}, depth_m = {} is out of range, allowed: x_m -1e6 to 1e6, "
                               "depth_m to 1e5; is it in metres? From map "
                               "coordinates detachment.shift_x_m leads to the breakaway",
                               text(p.x), text(-p.y)));
    }
    check_order(fault, tolerance);
    check_breakaway(fault, tolerance);
    check_gaps(fault);
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
    const FaultFit fit = fit_fault(fault.points, tolerance);
    if (!fit.flat)
        refuse(fault.where.back(),
               fmt::format("ends with a dip of {:.1f} degrees, but a detachment ends flat (within "
                           "tolerance_m = {}); add points down to where it is flat",
                           fit.end_dip, text(tolerance)));
    if (fit.misfit > tolerance)
        refuse(fault.where[fit.worst],
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
    return picked;
}

std::string describe(const PickedFault& picked, const DetachmentParameters& detachment) {
    return fmt::format("detachment: {} arcs and lines through {} points, at most {:.1f} m off",
                       detachment.segments.size(), picked.x.size(), picked.misfit);
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
