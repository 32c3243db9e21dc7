#include "apps/measures/paper/lower_block.hpp"

#include "dem/contacts/cells.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

constexpr Quantity bounded_on{
    "lower_block_bounded_share", "1", "share of the lower block's bounds that shear",
    "share of 72 directions in which, from the lower block's middle, the detachment or a strain of "
    "0.05 in the last window comes within 12 km"};
constexpr Quantity low_angle_fault{
    "lower_block_low_angle_fault_m", "m", "length of low-angle faults in the lower block",
    "length of the normal traces' parts that dip by less than 30 degrees within 3 km of the block"};

Point centre_of(const ConstDiscColumns& d, const std::vector<std::size_t>& block) {
    Point middle;
    for (std::size_t i : block)
        middle = {middle.x + d.x[i] / static_cast<double>(block.size()),
                  middle.y + d.y[i] / static_cast<double>(block.size())};
    return middle;
}

/// Share of directions, seen from a point, in which strain of a fault or the detachment comes
/// before 12 km of other rock.
double bounded_share(const RunSoFar& run, Point middle) {
    constexpr int directions = 72;
    constexpr double farthest = 12e3; // m
    const ShearField& field = run.last_window;
    const double reach = 1.5 * run.diameter;
    const Cells cells(field.x, field.y, reach);
    const double least = FaultTraceOptions{}.least_strain_in(field.window);
    const auto is_fault = [&](Point p) {
        double sum = 0.0, count = 0.0;
        cells.for_each_near(p.x, p.y, [&](std::int32_t row) {
            const auto k = static_cast<std::size_t>(row);
            if (hypotenuse(field.x[k] - p.x, field.y[k] - p.y) < reach) {
                sum += field.shear(k);
                count += 1.0;
            }
        });
        return count > 0.0 && sum >= least * count;
    };
    const auto is_bound = [&](Point p) {
        const auto foot = foot_point(run.detachment, p);
        return (foot && foot->distance < 0.0) || is_fault(p);
    };
    int bounded = 0;
    for (int n = 0; n < directions; ++n) {
        const double a = 2.0 * pi * n / directions;
        for (double s = 5.0 * run.diameter; s < farthest; s += 0.5 * run.diameter)
            if (is_bound({middle.x + s * std::cos(a), middle.y + s * std::sin(a)})) {
                ++bounded;
                break;
            }
    }
    return static_cast<double>(bounded) / directions;
}

/// Length of the gently dipping parts of normal faults near the block, m.
double low_angle_length(const RunSoFar& run, const std::vector<std::size_t>& block,
                        std::span<const Fault> faults) {
    constexpr double near = 3e3; // m
    const auto is_near = [&](Point p) {
        return std::ranges::any_of(block, [&](std::size_t i) {
            return hypotenuse(run.discs.x[i] - p.x, run.discs.y[i] - p.y) < near;
        });
    };
    double length = 0.0;
    for (const Fault& f : faults)
        for (std::size_t k = 0; k + 1 < f.trace.points.size() && f.normal; ++k)
            if (const Point a = f.trace.points[k], b = f.trace.points[k + 1];
                is_low_angle(a, b) && is_near(a))
                length += norm(b - a);
    return length;
}

} // namespace

NamedNumbers measure_lower_block(const RunSoFar& run, const RampFlatRamp& parts,
                                 std::span<const Fault> faults) {
    constexpr std::size_t fewest = 20; // discs
    const std::vector<std::size_t> block = lower_block(run.now, run.detachment, parts);
    if (block.size() < fewest)
        return {};
    NamedNumbers numbers;
    add(numbers, bounded_on, bounded_share(run, centre_of(run.discs, block)));
    add(numbers, low_angle_fault, low_angle_length(run, block, faults));
    return numbers;
}

std::span<const Quantity> lower_block_quantities() {
    static constexpr Quantity all[] = {bounded_on, low_angle_fault};
    return all;
}

} // namespace listric::measures
