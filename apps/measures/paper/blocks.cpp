#include "apps/measures/paper/blocks.hpp"

#include "apps/measures/basin/kinematics.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

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
    return std::atan2(sine, cosine) * 180.0 / pi;
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
double foot_dip(const Foot& foot) { return std::atan2(foot.normal.x, foot.normal.y); }

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
    const double least_dip = std::atan2(-down.y, down.x) / 3.0; // flatter, it hardly turns anything
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

} // namespace listric::measures
