#pragma once

#include "apps/measures/polyline.hpp"
#include "dem/base.hpp"

#include <span>

namespace listric::measures {

/// Porosity of sediment by depth z below the ground: surface exp(-decay z) (Athy 1930).
struct PorosityByDepth {
    double surface = 0.0; ///< as deposited
    double decay = 0.0;   ///< 1/m; 0: it does not compact
};

/// Where inclined shear (see inclined_shear_top) puts a horizon that was level at 0 when `since` of
/// the extension was to come: from the detachment to x = right, m, y up.
///
/// Sediment between the pre-rift top and the horizon compacts under what has come since, as a
/// vertical column that keeps its grains (Sclater and Christie 1980): the pre-rift top is where
/// shear puts it, and the horizon comes down. The basin is full, to 0, at all times.
/// @param since  from 0 (the ground) to extension (the pre-rift top)
Polyline predicted_horizon(const dem::Chain& detachment, double extension, double since,
                           double angle, double right, const PorosityByDepth& porosity);

/// Depths of a line, whose x need not ascend, at ascending x: linear between its points, level
/// beyond its ends; m.
std::vector<double> depths_at(const Polyline& line, std::span<const double> x);

} // namespace listric::measures
