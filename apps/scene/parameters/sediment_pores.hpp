#pragma once

#include "fluid/pore_law.hpp"

namespace listric {

/// How sediment compacts, and how it lets water through.
struct SedimentPores {
    double surface_porosity = 0.5; ///< as deposited
    double coefficient = 4e-4;     ///< decay of porosity with depth, 1/m
    fluid::Permeability permeability = {};
};

} // namespace listric
