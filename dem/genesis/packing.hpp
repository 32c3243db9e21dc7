#pragma once

#include "dem/base.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/state.hpp"

#include <functional>
#include <span>
#include <vector>

namespace listric::dem {

// Steps of making a packing, shared by the hanging wall and the samples of the laboratory.

/// Radii are uniformly distributed between these, m.
struct RadiusRange {
    double smallest, largest;

    double mean_square() const {
        return (largest * largest + largest * smallest + smallest * smallest) / 3.0;
    }
};

/// Uniform distribution with the given mean and ratio of largest to smallest.
RadiusRange radius_range(double mean_radius, double radius_ratio);

/// Radii of discs drawn from a range, keyed by seed and row, m.
std::vector<double> draw_radii(const RadiusRange& range, std::size_t discs, std::uint64_t seed);

/// Random places for discs of the given radii inside the base so that none overlaps (random
/// sequential addition), between x = 0 and `width`, `bottom` and `top`. Throws NumericalFailure if
/// there is no room.
std::vector<Point> scatter(const RigidBase& base, std::span<const double> radius, double width,
                           double bottom, double top, std::uint64_t seed);

void stop_discs(State& state);

/// Puts discs of the given final radii at random places, smaller than they shall be, and lets them
/// grow while they push each other apart. Weightless.
void scatter_and_expand(State& state, const RigidBase& base, std::span<const double> radius,
                        double width, double bottom, double top, double damping,
                        const std::function<void(std::string_view, double)>& report,
                        const Execution& execution = {});

/// Cycles until the mean unbalanced force falls below `ratio` of the mean contact force and the
/// base carries the weight to one percent; or until the limit. Without gravity the base must not be
/// pulled down, which is chance where forces are small: then the limit often ends it.
void settle(State& state, const RigidBase& base, const CyclePhysics& physics, double ratio,
            int limit, const std::function<void(double)>& report, const Execution& execution = {});

/// Bonds every touching pair. Strengths are keyed by `occasion`.
void bond_touching(State& state, const BondStrength& strength, std::int64_t occasion);

} // namespace listric::dem
