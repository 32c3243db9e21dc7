#pragma once

#include "dem/beds.hpp"

#include <span>

namespace listric::measures {

/// A stratum as a well meets it.
struct DrilledStratum {
    double grains = 0.0; ///< its thickness without pores, m
    dem::PorosityLaw pores = {};
};

struct BackstrippingDensities {
    double mantle = 3300.0, water = 1030.0, grains = 2600.0; ///< kg/m^3
};

/// Strata on each other whose pores are as the depth of each has them.
struct SedimentColumn {
    double thickness = 0.0; ///< m
    double density = 0.0;   ///< mean, with water in the pores, kg/m^3
};

/// @param strata  the oldest first; the last lies at the ground
SedimentColumn decompacted(std::span<const DrilledStratum> strata,
                           const BackstrippingDensities& densities);

/// What is left of a basin's subsidence without the weight of its sediment, in one dimension:
/// depth that it had if it were full of water alone (Steckler & Watts 1978), m.
/// @param depth  of the ground below the sea, m
/// @param rise   of the sea since extension began, m
double tectonic_subsidence(const SedimentColumn& column, const BackstrippingDensities& densities,
                           double depth = 0.0, double rise = 0.0);

} // namespace listric::measures
