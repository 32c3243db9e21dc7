#pragma once

#include <optional>

namespace listric::thermal {

/// Temperature of discs and of the rock around them down to the base of the lithosphere.
struct HeatParameters {
    double surface_temperature = 10.0;       ///< of the ground or the sea floor, degrees Celsius
    double lithosphere = 125e3;              ///< depth of its base, m [McKenzie 1978]
    double base_temperature = 1333.0;        ///< kept there, degrees Celsius [McKenzie 1978]
    double crust = 30e3;                     ///< thickness, m
    double conductivity = 2.5;               ///< of the crust, W/m/K
    double mantle_conductivity = 3.3;        ///< W/m/K
    double grain_conductivity = 2.5;         ///< of sediment's grains, W/m/K
    double heat_production = 1e-6;           ///< of crust and of sediment's grains, W/m^3
    double interval = 50e3;                  ///< time between solutions, a
    std::optional<double> mantle_width = {}; ///< that stretches, m; none: as the lower crust
    /// Extension of lower crust and mantle by faults outside of the section, m.
    double regional_extension = 0.0;
    double expansion = 3.28e-5; ///< thermal, of rock and grains, 1/K [McKenzie 1978]
};

/// Heat capacities, J/m^3/K: the mantle's makes its diffusivity 0.8e-6 m^2/s.
inline constexpr double crust_capacity = 2.7e6, mantle_capacity = 4.1e6, grain_capacity = 2.6e6,
                        water_capacity = 4.2e6;
inline constexpr double water_conductivity = 0.64; ///< W/m/K

/// Conductivity of sediment, W/m/K: geometric mean of grains and water.
double sediment_conductivity(double grains, double porosity);

/// The steady column: crust with heat production over mantle without.
class Geotherm {
public:
    explicit Geotherm(const HeatParameters& p);

    double at(double depth) const; ///< degrees Celsius; above the ground: as there
    double surface_heat_flow() const { return surface_flow_; } ///< W/m^2
    double mantle_heat_flow() const { return mantle_flow_; }
    std::optional<double> depth_of(double temperature) const; ///< m; none: not in the lithosphere

private:
    HeatParameters p_;
    double surface_flow_, mantle_flow_;
};

} // namespace listric::thermal
