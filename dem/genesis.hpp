#pragma once

namespace listric {

/// The hanging wall before extension [paper, Table 1].
struct HangingWallParameters {
    double length = 40e3;         ///< from the breakaway to the moving wall, m
    double thickness = 15e3;      ///< greatest thickness = depth to the flat detachment, m
    double mean_radius = 93.1;    ///< mean disc radius, m
    double radius_ratio = 1.66;   ///< largest over smallest radius
    double porosity = 0.175;      ///< of the closed packing before gravity is applied
    double rock_density = 2600.0; ///< bulk density of the packing, kg/m^3
};

} // namespace listric
