#pragma once

#include "fem/footwall.hpp"

#include <optional>
#include <string>

namespace listric {

/// A base that bends and floats, as effects that load it and the plan of its flexure see it.
struct BendingBase {
    double elastic_thickness = 10e3; ///< effective elastic thickness Te, m
    double young_modulus = 70e9;     ///< Pa
    double poisson_ratio = 0.25;
    double crust_density = 2700.0;  ///< kg/m^3
    double mantle_density = 3300.0; ///< kg/m^3
    /// Of what flows in where the base rises, kg/m^3; none: the mantle's.
    std::optional<double> asthenosphere_density = {};
    double infill_density = 0.0; ///< of what fills the deflection, kg/m^3
    double left = -300e3;        ///< x of the footwall's far side, m
    double right = 350e3;        ///< of the other one, under discs, m
    int cells = 8;               ///< elements through the elastic thickness, without discs
    int degree = 2;              ///< of the elements
    fem::Solver solver = fem::Solver::mumps;

    double floats_on() const { return asthenosphere_density.value_or(mantle_density); } ///< kg/m^3
};

/// Why it would not float upright; empty if it does.
std::string objection_to_densities(const BendingBase& base);

/// Why nothing of that density, kg/m^3, can fill what sinks under it; empty if it can.
std::string objection_to_fill(double density, const BendingBase& base);

} // namespace listric
