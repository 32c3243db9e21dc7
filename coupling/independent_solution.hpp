#pragma once

#include "coupling/interface.hpp"
#include "fem/footwall.hpp"

#include <span>
#include <vector>

namespace listric {

/// The base once more, from forces on the interface that a run has recorded.
struct IndependentSolution {
    std::size_t unknowns = 0;         ///< of the mesh
    std::vector<double> displacement; ///< of the recorded interface's nodes, m
    double difference = 0.0;          ///< from the recorded displacement: root mean squares' ratio
};

/// Tractions whose equivalent forces on the nodes are `forces`, Pa: the faces' mass matrix
/// inverted.
std::vector<double> tractions(const Interface& interface, std::span<const double> forces);

/// Makes a footwall with elements half as large, puts the forces on it as tractions, which no mesh
/// owns, and compares.
/// @param forces        on the interface's unknowns, N
/// @param displacement  that the run has recorded with them, m
/// @param other         loads elsewhere
/// Throws fem::FootwallError.
IndependentSolution solve_independently(fem::FootwallRequest request, const Interface& interface,
                                        std::span<const double> forces,
                                        std::span<const double> displacement,
                                        const fem::Load& other = {});

} // namespace listric
