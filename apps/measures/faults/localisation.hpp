#pragma once

#include "apps/measures/setting.hpp"
#include "dem/event.hpp"
#include "dem/events/strain.hpp"

#include <optional>
#include <span>

namespace listric::measures {

/// Share of `amount` held by the given share of `area` where it is densest.
double share_of_densest(std::span<const double> density, std::span<const double> area,
                        double area_share);

/// Gini coefficient of a density over area: 0 uniform, 1 all in one place.
double gini(std::span<const double> density, std::span<const double> area);

/// How much the strain of the pre-rift rock is in few places, and how fast it is there.
struct Localisation {
    double top10 = 0.0;            ///< share of the last window's strain in a tenth of the area
    double top10_cumulative = 0.0; ///< share of all strain
    double gini = 0.0;             ///< of the last window's strain
    double inertial_number = 0.0;  ///< of that tenth of the area where it is largest; 0 without
                                   ///< gravity
};

/// After some extension; before the first window is over, it is what there is of it.
Localisation measure_localisation(const Setting& setting, const dem::State& state,
                                  const dem::Strain& strain);

} // namespace listric::measures
