#pragma once

#include "coupling/interface.hpp"
#include "fem/footwall.hpp"

#include <span>
#include <vector>

namespace listric::coupling {

/// The base once more, from forces on the interface that a run has recorded.
struct IndependentSolution {
    std::size_t unknowns = 0;         ///< of the mesh
    std::vector<double> displacement; ///< of the recorded interface's nodes, m
};

/// Root mean square of a - b over that of b.
double relative_difference(std::span<const double> a, std::span<const double> b);

/// Tractions whose equivalent forces on the nodes are `forces`, Pa: the faces' mass matrix
/// inverted.
std::vector<double> tractions(const Interface& interface, std::span<const double> forces);

/// Solves on a footwall with elements half as large, with the forces put on it as tractions, which
/// no mesh owns.
/// @param request  of the run's footwall
/// @param forces   on the interface's unknowns, N
/// @param other    loads elsewhere
/// @param relaxing where the run's footwall relaxes, by which other.stress is
/// Throws fem::FootwallError.
IndependentSolution solve_independently(fem::FootwallRequest request, const Interface& interface,
                                        std::span<const double> forces, const fem::Load& other = {},
                                        std::span<const fem::StressPoint> relaxing = {});

} // namespace listric::coupling
