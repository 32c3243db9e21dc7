#include "apps/model/effects/base_motion/ground.hpp"

#include "dem/columns.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace listric::effects::base_motion {

using namespace dem;

namespace {

constexpr double broken_share = 0.5;        ///< of a window's slip, on one step at the ground
constexpr double diameters_of_window = 0.1; ///< slip between looks
constexpr std::size_t columns_of_mean = 3, columns_apart = 5;

/// Mean displacements of the uppermost two diameters of rock in columns a mean diameter wide.
struct GroundMotion {
    double left = 0.0, width = 1.0; ///< m
    std::vector<double> x, y, count;

    /// Mean of columns from one on; none where there is no rock.
    std::optional<Point> mean(std::size_t from, std::size_t columns) const {
        Point sum;
        double discs = 0.0;
        for (std::size_t k = from; k < from + columns; ++k) {
            sum = {sum.x + x[k], sum.y + y[k]};
            discs += count[k];
        }
        return discs > 0.0 ? std::optional(Point{sum.x / discs, sum.y / discs}) : std::nullopt;
    }
};

/// @param from_x, from_y  where discs were, m
GroundMotion ground_motion(const State& state, std::span<const double> from_x,
                           std::span<const double> from_y) {
    const ConstDiscColumns d = disc_columns(state);
    const auto ends = std::ranges::minmax(d.x);
    const double low = ends.min;
    GroundMotion ground{low, 2.0 * state.mean_radius, {}, {}, {}};
    const auto column = [&](std::size_t i) {
        return static_cast<std::size_t>((d.x[i] - low) / ground.width);
    };
    const auto columns = static_cast<std::size_t>((ends.max - low) / ground.width) + 1;
    std::vector<double> top(columns, -std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] == 0)
            top[column(i)] = std::max(top[column(i)], d.y[i]);
    ground.x.resize(columns);
    ground.y.resize(columns);
    ground.count.resize(columns);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const std::size_t k = column(i);
        if (d.stratum[i] != 0 || d.y[i] < top[k] - 2.0 * ground.width)
            continue;
        ground.x[k] += d.x[i] - from_x[i];
        ground.y[k] += d.y[i] - from_y[i];
        ground.count[k] += 1.0;
    }
    return ground;
}

/// @param measure  size of a difference of displacements, m
template <class Size> GroundStep greatest_step(const GroundMotion& ground, Size size) {
    GroundStep greatest;
    constexpr std::size_t reach = columns_apart + columns_of_mean;
    for (std::size_t k = 0; k + reach <= ground.x.size(); ++k) {
        const auto left = ground.mean(k, columns_of_mean),
                   right = ground.mean(k + columns_apart, columns_of_mean);
        if (!left || !right)
            continue;
        const double found = size({right->x - left->x, right->y - left->y});
        if (found > greatest.size)
            greatest = {found, ground.left + (static_cast<double>(k) + 0.5 * reach) * ground.width};
    }
    return greatest;
}

void remember_places(State& state) {
    const DiscColumns d = disc_columns(state);
    std::ranges::copy(d.x, state.discs.get<double>("offset_from_x").begin());
    std::ranges::copy(d.y, state.discs.get<double>("offset_from_y").begin());
}

} // namespace

double SlippedFault::throw_of_slip() const { return std::abs(slip) * sine(dip); }

std::optional<SlippedFault> slipped_fault(const RigidBase& base, double extension) {
    const Surface* const block = find_basement_block(base);
    if (!block)
        return std::nullopt;
    const Surface& left = base.surfaces.front();
    const Segment& scarp = left.chain.back();
    const Point per_extension{block->translation.x - left.translation.x,
                              block->translation.y - left.translation.y};
    return SlippedFault{
        {scarp.start.x + left.translation.x * extension, scarp.start.y},
        arc_tangent(-scarp.start_tangent.y, scarp.start_tangent.x),
        -std::copysign(hypotenuse(per_extension.x, per_extension.y), per_extension.y) * extension,
        -scarp.start.y};
}

GroundRecord::GroundRecord(double slip, double mean_radius, double rate)
    : Observer("ground_offset",
               Schedule::every(diameters_of_window * 2.0 * mean_radius / std::abs(slip), rate)) {}

void GroundRecord::begin(State& state) {
    state.discs.add<double>("offset_from_x", "m", 0.0);
    state.discs.add<double>("offset_from_y", "m", 0.0);
    memory.add<double>("slip_m", "m", 0.0);
    memory.add<double>("share", "1", 0.0);
    memory.add<double>("x_m", "m", 0.0);
    remember_places(state);
}

bool GroundRecord::apply(State& state, const RigidBase& base) {
    const double slip = slipped_fault(base, state.clock.extension.m).value().slip;
    const double before = memory.rows() > 0 ? memory.get<double>("slip_m").back() : 0.0;
    const double slipped = std::abs(slip - before);
    const GroundMotion ground = ground_motion(state, state.discs.get<double>("offset_from_x"),
                                              state.discs.get<double>("offset_from_y"));
    const GroundStep step = greatest_step(ground, [](Point u) { return hypotenuse(u.x, u.y); });
    remember_places(state);
    memory.resize(memory.rows() + 1);
    memory.get<double>("slip_m").back() = slip;
    memory.get<double>("share").back() = slipped > 0.0 ? step.size / slipped : 0.0;
    memory.get<double>("x_m").back() = step.x;
    return false;
}

std::optional<double> GroundRecord::share() const {
    return memory.rows() > 0 ? std::optional(memory.get<double>("share").back()) : std::nullopt;
}

std::optional<double> GroundRecord::x() const {
    return memory.rows() > 0 ? std::optional(memory.get<double>("x_m").back()) : std::nullopt;
}

std::optional<GroundStep> GroundRecord::breakthrough() const {
    const auto slip = memory.get<double>("slip_m"), share = memory.get<double>("share"),
               x = memory.get<double>("x_m");
    for (std::size_t k = 1; k < share.size(); ++k)
        if (share[k - 1] >= broken_share && share[k] >= broken_share)
            return GroundStep{std::abs(slip[k - 1]), x[k]};
    return std::nullopt;
}

Monocline measure_monocline(const State& state, const SlippedFault& fault) {
    const ConstDiscColumns d = disc_columns(state);
    const GroundMotion ground = ground_motion(state, d.start_x, d.start_y);
    Monocline fold;
    const GroundStep steepest = greatest_step(ground, [](Point u) { return std::abs(u.y); });
    fold.slope = arc_tangent(steepest.size / (columns_apart * ground.width)) * 180.0 / pi;
    std::optional<double> begins;
    for (std::size_t k = 0; k + columns_of_mean <= ground.x.size() && !fold.width; ++k) {
        const auto mean = ground.mean(k, columns_of_mean);
        if (!mean)
            continue;
        const double x = static_cast<double>(k) * ground.width; // from the first
        const double share = std::abs(mean->y) / fault.throw_of_slip();
        if (share < 0.1)
            begins = x;
        else if (share >= 0.9 && begins)
            fold.width = x - *begins;
    }
    return fold;
}

} // namespace listric::effects::base_motion
