#include "apps/measures/paper/kink.hpp"

#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

constexpr Quantity strain_share{
    "kink_reverse_strain_share", "1", "reverse strain above the kink",
    "ramp-flat-ramp, rock and old sediment above the flat's level from 3 km before the kink to 6 "
    "km beyond, the windows since half of the extension: share of the shear strain on reverse "
    "planes that dip toward the breakaway by 20 to 80 degrees. A disc has two planes of largest "
    "shear; the one counts whose simple shear turns as its surroundings do"};
constexpr Quantity fault_share{
    "kink_reverse_fault_share", "1", "reverse strain on faults above the kink",
    "part of `kink_reverse_strain_share` on faults: within the measure circle of a reverse segment "
    "that fault detection found in the window. 0 without fault detection"};
constexpr Quantity synrift_shortening{"kink_synrift_shortening", "1",
                                      "shortening of sediment above the kink",
                                      "mean horizontal shortening of the sediment above the kink, "
                                      "summed over the windows since half of the extension"};
constexpr Quantity reverse_trace{"kink_reverse_trace_m", "m",
                                 "length of reverse faults above the kink",
                                 "length of the traced reverse faults above the kink"};

constexpr double before_kink = 3e3, beyond_kink = 6e3; ///< along x, m
constexpr double gentlest = 20.0, steepest = 80.0;     ///< dip of reverse faults, degrees

bool is_reverse_dip(double degrees) { return degrees > gentlest && degrees < steepest; }

/// Centres of the segments found in a window that slid as reverse faults dipping to the breakaway.
std::vector<Point> reverse_segments(std::span<const DetectedSegment> segments, Travel from,
                                    Travel to) {
    constexpr Travel tolerance(1.0); // an interval and a window may end in the same cycle
    std::vector<Point> centres;
    for (const DetectedSegment& s : segments)
        if (s.found_at > from + tolerance && s.found_at < to + tolerance && s.slip > 0.0 &&
            is_reverse_dip(s.dip))
            centres.push_back(s.centre);
    return centres;
}

/// Sums over the rock and sediment above the kink in one window, times areas.
struct AboveKink {
    double strain = 0.0, reverse = 0.0, on_faults = 0.0, sediment = 0.0, stretch = 0.0;
};

/// @param segments  of reverse faults
AboveKink sum_above_kink(const RunSoFar& run, const ShearField& field,
                         const std::vector<Point>& segments, double kink, double flat_depth) {
    const double reach = 0.5 * run.setting.detection_circle.value_or(0.0) * run.diameter;
    AboveKink sum;
    for (std::size_t k = 0; k < field.x.size(); ++k) {
        const Point p{field.x[k], field.y[k]};
        if (p.y < -flat_depth || p.x < kink - before_kink || p.x > kink + beyond_kink)
            continue;
        const std::size_t i = run.row(field, k);
        const double area = run.discs.radius[i] * run.discs.radius[i];
        if (run.discs.stratum[i] > 0) {
            sum.sediment += area;
            sum.stretch += area * field.xx[k];
        }
        const ShearPlane plane = shear_plane(field, k);
        sum.strain += area * plane.strain;
        if (!plane.reverse || plane.falls_right || plane.dip < gentlest || plane.dip > steepest)
            continue;
        sum.reverse += area * plane.strain;
        if (std::ranges::any_of(segments, [&](Point s) { return norm(s - p) < reach; }))
            sum.on_faults += area * plane.strain;
    }
    return sum;
}

/// Since half of the extension: by then the upper block's toe turns back.
NamedNumbers measure_above_kink(const RunSoFar& run, std::span<const DetectedSegment> segments,
                                double kink, double flat_depth) {
    double strain = 0.0, reverse = 0.0, on_faults = 0.0, shortening = 0.0;
    for (std::size_t k = 0; k < run.past.size(); ++k) {
        const DiscPlaces& end = run.end_of_window(k);
        if (run.has_come_to(0.5 * run.extension, end.extension))
            continue;
        const AboveKink sum = sum_above_kink(
            run, run.window(k), reverse_segments(segments, run.past[k].places.travel, end.travel),
            kink, flat_depth);
        strain += sum.strain;
        reverse += sum.reverse;
        on_faults += sum.on_faults;
        if (sum.sediment > 0.0)
            shortening -= sum.stretch / sum.sediment;
    }
    if (!(strain > 0.0))
        return {};
    NamedNumbers numbers;
    add(numbers, strain_share, reverse / strain);
    add(numbers, fault_share, on_faults / strain);
    add(numbers, synrift_shortening, shortening);
    return numbers;
}

} // namespace

ShearPlane shear_plane(const ShearField& field, std::size_t k) {
    // Simple shear g on a plane of direction t: grad u = g t n, so that u_xx - u_yy = -g sin
    // 2a, u_xy + u_yx = g cos 2a and u_xy - u_yx = g for t = (cos a, sin a).
    const PlaneShear shear = field.components(k);
    const double sign = field.xy[k] >= field.yx[k] ? 1.0 : -1.0;
    double a = 0.5 * dem::arc_tangent(-sign * shear.stretch, sign * shear.turn);
    if (a > 0.0)
        a -= pi; // downward
    ShearPlane plane;
    plane.strain = shear.size();
    plane.falls_right = dem::cosine(a) > 0.0;
    plane.dip = (plane.falls_right ? -a : a + pi) * 180.0 / pi;
    // g > 0: the left of the downward direction moves down; that is the side above a plane that
    // falls right.
    plane.reverse = (sign > 0.0) != plane.falls_right;
    return plane;
}

NamedNumbers measure_kink(const RunSoFar& run, const RampFlatRamp& parts,
                          std::span<const Fault> faults,
                          std::span<const DetectedSegment> segments) {
    const double kink = point_at(run.detachment, parts.flat_end).x;
    NamedNumbers numbers = measure_above_kink(run, segments, kink, parts.flat_depth);
    double traced = 0.0;
    for (const Fault& f : faults)
        if (const Point middle = f.trace.points[f.trace.points.size() / 2];
            !f.normal && middle.x > kink - before_kink && middle.x < kink + beyond_kink)
            traced += f.trace.length();
    add(numbers, reverse_trace, traced);
    return numbers;
}

std::span<const Quantity> kink_quantities() {
    static constexpr Quantity all[] = {strain_share, fault_share, synrift_shortening,
                                       reverse_trace};
    return all;
}

} // namespace listric::measures
