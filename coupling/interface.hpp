#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"
#include "fem/footwall.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace listric::coupling {

/// The detachment as the footwall's elements see it, condensed: what the discs rest on. Unknowns
/// are x and y of the first node, x and y of the second, ...
struct Interface {
    std::vector<double> x, y; ///< nodes from the breakaway down, m
    int degree = 2;           ///< of the faces; face k has nodes degree * k to degree * (k + 1)
    std::vector<double> compliance; ///< by rows, m per N/m

    std::size_t unknowns() const { return 2 * x.size(); }
};

/// Condenses a footwall. Throws fem::FootwallError.
Interface condense(fem::Footwall& footwall, int degree);

/// Equivalent forces on the nodes of an upward pressure of 1 Pa on the wall between two
/// x, m, on its horizontal projection and its reference place; y components, N.
std::vector<double> pressure_forces(const Interface& interface, double from, double to);

/// Two mean disc diameters, m: the highest disc of a column is then the surface.
inline double water_column_width(double mean_radius) { return 4.0 * mean_radius; }

/// The interface below columns of one width from the breakaway on.
class InterfaceColumns {
public:
    InterfaceColumns(const Interface& interface, double width);

    double width() const { return width_; }
    std::size_t unknowns() const { return 2 * nodes_; }

    /// Puts pressures on the columns as an effect's load, downward, Pa.
    void put(dem::State& state, std::string_view effect, std::span<const double> pressure) const;

private:
    double width_;
    std::size_t nodes_;
    std::vector<std::vector<double>> per_pascal_; ///< by column: forces on the nodes, upward, N
};

/// Errors of the transfer between discs and nodes: round-off.
struct InterfaceBalance {
    double force_error = 0.0;  ///< |forces on nodes + forces on discs| over the sum of magnitudes
    double moment_error = 0.0; ///< error of moments about the breakaway, in the deformed wall
    double work_error = 0.0;   ///< and of power, with the nodes' velocities
};

/// Measures the contacts as they stand.
InterfaceBalance interface_balance(const dem::State& state, const dem::RigidBase& base);

} // namespace listric::coupling
