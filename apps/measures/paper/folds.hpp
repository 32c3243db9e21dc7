#pragma once

#include "apps/measures/paper/blocks.hpp"
#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <map>
#include <optional>
#include <span>

namespace listric::measures {

/// Basins and rollovers to both sides of the syncline above a ramp-flat-ramp.
NamedNumbers measure_syncline(const RunSoFar& run, const RampFlatRamp& parts);

std::span<const Quantity> syncline_quantities();

/// How far the deformation lies in the hanging wall in the last window, beside early windows.
NamedNumbers measure_hinge(const RunSoFar& run);

std::span<const Quantity> hinge_quantities();

/// How far strata lie lower on the floor of the main collapse graben than on its margins.
struct Relief {
    /// By stratum, 0: pre-rift top; of the margin toward the breakaway, the intervening high, m.
    /// Tops of discs tell a height to a diameter, so of strata that lie closer on the floor than
    /// three diameters above the last one only the first that does not is there.
    std::map<int, double> inner;
    double outer = 0.0; ///< of the pre-rift top at the margin toward the moving wall, m
};

/// None without a collapse graben.
std::optional<Relief> find_relief(const dem::State& state, const Profile& profile);

NamedNumbers measure_relief(const RunSoFar& run);

std::span<const Quantity> relief_quantities();

} // namespace listric::measures
