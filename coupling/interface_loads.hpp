#pragma once

#include "dem/state.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace listric::coupling {

// Loads on the footwall that no disc brings: what thins below it, what is eroded from it, water on
// it. Each is kept as forces on the interface's nodes, which are superposed with the discs'.
// State::base_memory has a table for loads on the interface, "interface_loads", and one for loads
// elsewhere, "footwall_loads": forces that displace the interface as the load itself does, C f = u.
// Both have a column per effect, in N per m of strike: x and y of the first node, the second and
// so on.

/// Where an effect keeps its forces; adds the column if it is not there.
std::span<double> footwall_load(dem::State& state, std::string_view effect, std::size_t unknowns);
std::span<double> interface_load(dem::State& state, std::string_view effect, std::size_t unknowns);

/// Weight of an effect's load on the interface, N per m of strike; 0 without.
double weight_on_interface(const dem::State& state, std::string_view effect);

/// Sum of the loads on the interface itself; empty without any.
std::vector<double> interface_loads(const dem::State& state);

/// Sum of the loads elsewhere, zero without any.
std::vector<double> loads_elsewhere(const dem::State& state, std::size_t unknowns);

bool has_footwall_loads(const dem::State& state);

/// Adds the forces of all effects, elsewhere and on the interface.
void add_footwall_loads(const dem::State& state, std::span<double> forces);

} // namespace listric::coupling
