#include "apps/measures/paper/blocks.hpp"

#include "apps/measures/basin/kinematics.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

constexpr double head_block_width = 5e3;      ///< m from the detachment
constexpr double block_size = 1.5e3;          ///< of what turns as one on a ramp-flat-ramp, m
constexpr double toe_dip = 15.0 * pi / 180.0; ///< of the upper ramp below the toe, at most

/// Rotation, degrees, of the least-squares rigid motion of a block of discs. RigidMotion finds the
/// same but for the last digits: it sums n-ths, and g++ 12 fuses products of its pairs, which lie
/// side by side (see floating_point_flags).
std::optional<double> rotation_of(const State& state, std::span<const std::size_t> block) {
    const ConstDiscColumns d = disc_columns(state);
    if (block.size() < 3)
        return std::nullopt;
    Point before, after;
    for (std::size_t i : block) {
        before = {before.x + d.start_x[i], before.y + d.start_y[i]};
        after = {after.x + d.x[i], after.y + d.y[i]};
    }
    const auto n = static_cast<double>(block.size());
    before = {before.x / n, before.y / n};
    after = {after.x / n, after.y / n};
    double sine = 0.0, cosine = 0.0;
    for (std::size_t i : block) {
        const double ax = d.start_x[i] - before.x, ay = d.start_y[i] - before.y;
        const double bx = d.x[i] - after.x, by = d.y[i] - after.y;
        sine += ax * by - ay * bx;
        cosine += ax * bx + ay * by;
    }
    return dem::arc_tangent(sine, cosine) * 180.0 / pi;
}

/// Mean rotation, degrees, of the square patches of a block that deforms.
std::optional<double> mean_rotation(const State& state, std::span<const std::size_t> block,
                                    double patch) {
    const ConstDiscColumns d = disc_columns(state);
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::size_t>> patches;
    for (std::size_t i : block)
        patches[{std::llround(d.start_x[i] / patch), std::llround(d.start_y[i] / patch)}].push_back(
            i);
    double sum = 0.0, discs = 0.0;
    for (const auto& [place, members] : patches) {
        constexpr std::size_t fewest = 4; // slivers at the block's edge tell nothing
        if (members.size() < fewest)
            continue;
        sum += *rotation_of(state, members) * static_cast<double>(members.size());
        discs += static_cast<double>(members.size());
    }
    return discs > 0.0 ? std::optional(sum / discs) : std::nullopt;
}

/// Rows of the pre-rift discs of whose start `chosen(start, foot on the detachment)` is true.
template <class Chosen>
std::vector<std::size_t> block_of(const State& state, const Chain& detachment, Chosen&& chosen) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<std::size_t> block;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] == 0)
            if (const Point start{d.start_x[i], d.start_y[i]};
                chosen(start, foot_point(detachment, start)))
                block.push_back(i);
    return block;
}

/// Dip of the detachment at a foot on it.
double foot_dip(const Foot& foot) { return dem::arc_tangent(foot.normal.x, foot.normal.y); }

/// Where the last piece ends that turns what slides along it, m along the chain.
double turning_ends(const Chain& detachment) {
    constexpr double straight = 1e-12; // 1/m
    constexpr double corner = 1e-6;    // of a unit tangent
    double at = 0.0, end = 0.0;
    Point before = detachment.front().start_tangent;
    for (const Segment& s : detachment) {
        if (hypotenuse(s.start_tangent.x - before.x, s.start_tangent.y - before.y) > corner)
            end = at;
        at += s.length;
        if (std::abs(s.curvature) > straight)
            end = at;
        before = s.end_tangent;
    }
    return end;
}

} // namespace

std::optional<RampFlatRamp> find_ramp_flat_ramp(const Chain& detachment) {
    constexpr double level = 1e-6; // of a unit tangent's y
    constexpr double least_depth = 1.0;
    const auto flat = [](Point tangent) { return std::abs(tangent.y) < level; };
    RampFlatRamp found;
    double at = 0.0;
    bool on_flat = false, in_kink = false;
    for (const Segment& s : detachment) {
        if (in_kink && s.curvature >= 0.0)
            break;
        if (on_flat && !in_kink && !(flat(s.start_tangent) && flat(s.end_tangent))) {
            in_kink = true;
            found.flat_end = at;
            if (s.curvature >= 0.0) { // a corner
                found.lower_start = at;
                break;
            }
        }
        if (in_kink)
            found.lower_start = at + s.length;
        if (!on_flat && flat(s.end_tangent) && s.end.y < -least_depth) {
            on_flat = true;
            found.flat_depth = -s.end.y;
            found.flat_start = flat(s.start_tangent) ? at : at + s.length;
        }
        at += s.length;
    }
    return in_kink ? std::optional(found) : std::nullopt;
}

std::vector<std::size_t> lower_block(const State& state, const Chain& detachment,
                                     const RampFlatRamp& parts) {
    const double height = -detachment.back().end.y - parts.flat_depth;
    return block_of(state, detachment, [&](Point start, const auto& foot) {
        return -start.y > parts.flat_depth && foot && foot->arc_length > parts.lower_start &&
               foot->normal.x > 1e-6 && foot->distance < 0.5 * height;
    });
}

std::vector<std::size_t> head_block(const State& state, const Chain& detachment, double thickness) {
    const double turns = turning_length(detachment), still = turns - state.clock.extension.m;
    const double depth = turns > 0.0 ? -point_at(detachment, turns).y : thickness;
    const Point down = detachment.front().start_tangent;
    const double least_dip =
        dem::arc_tangent(-down.y, down.x) / 3.0; // flatter, it hardly turns anything
    return block_of(state, detachment, [&](Point start, const auto& foot) {
        if (-start.y > 0.5 * depth)
            return false;
        if (!foot)
            return start.x < head_block_width;
        return foot->distance < head_block_width &&
               (turns == 0.0 || (foot->arc_length <= still && foot_dip(*foot) >= least_dip));
    });
}

std::optional<double> head_block_tilt(const State& state, const Chain& detachment,
                                      double thickness) {
    return rotation_of(state, head_block(state, detachment, thickness));
}

RampFlatRampRotations measure_ramp_flat_ramp(const State& state, const Chain& detachment,
                                             const RampFlatRamp& parts) {
    const double extension = state.clock.extension.m, end = turning_ends(detachment);
    const auto breakaway = block_of(state, detachment, [](Point start, const auto&) {
        return hypotenuse(start.x, start.y) < block_size;
    });
    double rear = end; // of the toe, m along the detachment
    const auto toe = block_of(state, detachment, [&](Point, const auto& foot) {
        const bool is_toe = foot && foot->arc_length < parts.flat_start &&
                            foot_dip(*foot) < toe_dip && foot->distance < block_size;
        if (is_toe)
            rear = std::min(rear, foot->arc_length);
        return is_toe;
    });
    RampFlatRampRotations found;
    if (extension <= parts.flat_start)
        found.breakaway = rotation_of(state, breakaway);
    if (rear + extension <= end)
        found.toe = rotation_of(state, toe);
    if (parts.lower_start + extension <= end)
        found.lower_block = mean_rotation(state, lower_block(state, detachment, parts), block_size);
    return found;
}

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
        const Point along{dem::cosine(a), dem::sine(a)};
        for (double s = 5.0 * run.diameter; s < farthest; s += 0.5 * run.diameter)
            if (is_bound({middle.x + s * along.x, middle.y + s * along.y})) {
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
