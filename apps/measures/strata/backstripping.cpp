#include "apps/measures/strata/backstripping.hpp"

#include "dem/numbers/elementary.hpp"

#include <cmath>

namespace listric::measures {

namespace {

/// Thickness of a stratum whose top lies at a depth: grains fill the rest of Athy's pores.
double thickness_at(double top, const DrilledStratum& stratum) {
    const auto [surface, decay] = stratum.pores;
    if (decay == 0.0)
        return stratum.grains / (1.0 - surface);
    const double pores = surface / decay * dem::exponential(-decay * top);
    double thickness = stratum.grains; // Newton from below: grains grow faster and faster with it
    for (int k = 0; k < 50; ++k) {
        const double closed = dem::exponential(-decay * thickness);
        const double missing = stratum.grains - thickness + pores * (1.0 - closed);
        const double change = missing / (1.0 - pores * decay * closed);
        thickness += change;
        if (std::abs(change) < 1e-9 * thickness)
            break;
    }
    return thickness;
}

} // namespace

SedimentColumn decompacted(std::span<const DrilledStratum> strata,
                           const BackstrippingDensities& densities) {
    double depth = 0.0, grains = 0.0;
    for (std::size_t k = strata.size(); k-- > 0;) {
        depth += thickness_at(depth, strata[k]);
        grains += strata[k].grains;
    }
    if (depth == 0.0)
        return {0.0, densities.water};
    const double share = grains / depth;
    return {depth, share * densities.grains + (1.0 - share) * densities.water};
}

double tectonic_subsidence(const SedimentColumn& column, const BackstrippingDensities& densities,
                           double depth, double rise) {
    const double displaced = densities.mantle - densities.water;
    return column.thickness * (densities.mantle - column.density) / displaced + depth -
           rise * densities.mantle / displaced;
}

} // namespace listric::measures
