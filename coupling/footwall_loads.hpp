#pragma once

#include "coupling/footwall_erosion.hpp"
#include "coupling/lower_crust_thinning.hpp"
#include "dem/state.hpp"
#include "fem/footwall.hpp"

#include <span>
#include <string_view>

namespace listric::coupling {

class ElasticBase;

// Loads on the footwall that no disc brings: what thins below it, what is eroded from it, water on
// it. Each is kept as forces on the interface's nodes, which are superposed with the discs'.
// State::base_memory has a table for loads on the interface, "interface_loads", and one for loads
// elsewhere, "footwall_loads": forces that displace the interface as the load itself does, C f = u.
// Both have a column per effect, in N per m of strike: x and y of the first node, the second and
// so on.

/// Where an effect keeps its forces; adds the column if it is not there.
std::span<double> footwall_load(dem::State& state, std::string_view effect, std::size_t unknowns);
std::span<double> interface_load(dem::State& state, std::string_view effect, std::size_t unknowns);

/// Sum of the loads on the interface itself; empty without any.
std::vector<double> interface_loads(const dem::State& state);

/// Forces on the interface, of discs and water, that hold the present displacement together with
/// the loads elsewhere.
std::vector<double> interface_forces(const ElasticBase& base, const dem::State& state);

bool has_footwall_loads(const dem::State& state);

/// Adds the forces of all effects.
void add_footwall_loads(const dem::State& state, std::span<double> forces);

/// The unit solutions that the effects superpose, solved for together.
struct FootwallResponses {
    SurfaceResponse surface;  ///< without knots where the surface is left alone
    LowerCrustResponse crust; ///< without rows where the lower crust is
};

/// Solves for the loads of the effects that are there.
/// @param unknowns  of the interface that is kept, which may end before the footwall's
/// @param contrast  of mantle and crust, times gravity, Pa/m
/// @param left      side of the footwall, m
/// Throws fem::FootwallError.
FootwallResponses solve_footwall_loads(fem::Footwall& footwall, std::size_t unknowns,
                                       const FootwallErosionParameters* erosion, double left,
                                       const LowerCrustThinningParameters* thinning,
                                       double contrast, double distance);

} // namespace listric::coupling
