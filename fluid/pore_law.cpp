#include "fluid/pore_law.hpp"
#include "dem/numbers/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace listric::fluid {

namespace {

double kozeny_carman(double porosity) {
    return porosity * porosity * porosity / ((1.0 - porosity) * (1.0 - porosity));
}

/// Natural logarithm of m^2 [Yang & Aplin 2010, eq. 6].
double mudstone(double clay, double e) {
    const double root = std::sqrt(clay);
    return -69.59 - 26.79 * clay + 44.07 * root + (-53.61 - 80.03 * clay + 132.78 * root) * e +
           (86.61 + 81.91 * clay - 163.61 * root) * std::sqrt(e);
}

double over_grains(double porosity) { return porosity / (1.0 - porosity); }

} // namespace

double permeability(const Permeability& mud, double porosity) {
    constexpr double least = 0.005, fifth = 0.2;
    porosity = std::max(porosity, least);
    switch (mud.law) {
    case PermeabilityLaw::kozeny_carman:
        return mud.at_fifth * kozeny_carman(porosity) / kozeny_carman(fifth);
    case PermeabilityLaw::mudstone:
        return dem::exponential(mudstone(mud.clay_fraction, over_grains(porosity)));
    case PermeabilityLaw::constant:
        break;
    }
    return mud.at_fifth;
}

double porosity_at(const PoreLaw& law, double depth) {
    return law.surface_porosity * dem::exponential(-law.decay * depth);
}

double grains_at(const PoreLaw& law, double depth) {
    return depth + law.surface_porosity / law.decay * dem::exponential_less_one(-law.decay * depth);
}

double equivalent_depth(const PoreLaw& law, double grains) {
    if (grains <= 0.0)
        return 0.0;
    // Newton from above: the function is convex, so that no step leads below the root.
    double depth =
        std::min(grains / (1.0 - law.surface_porosity), grains + law.surface_porosity / law.decay);
    for (int step = 0; step < 30; ++step) {
        const double change = (grains_at(law, depth) - grains) / (1.0 - porosity_at(law, depth));
        depth -= change;
        if (std::abs(change) <= 1e-12 * depth)
            break;
    }
    return depth;
}

double burial_under(const PoreLaw& law, double grains, double excess_pressure) {
    return equivalent_depth(law, grains - excess_pressure / law.grain_weight);
}

VoidRatio void_ratio(const PoreLaw& law, double grains, double burial, double excess_pressure) {
    const double depth = burial_under(law, grains, excess_pressure);
    const double porosity = porosity_at(law, depth), solid = 1.0 - porosity;
    VoidRatio e{over_grains(porosity), 0.0};
    if (depth > 0.0)
        e.slope = law.decay * porosity / (law.grain_weight * solid * solid * solid);
    if (depth >= burial)
        return e;
    const double least = over_grains(porosity_at(law, burial)); // so far
    return {least + law.rebound * (e.value - least), law.rebound * e.slope};
}

VoidRatio rock_pores(const PorousRock& rock, double load, double excess_pressure) {
    const double over = rock.compressibility / rock.porosity; // of its pores
    const double released = excess_pressure - load;
    if (released > 0.0)
        return {rock.porosity + rock.compressibility * released, rock.compressibility};
    const double pores = rock.porosity * dem::exponential(over * released);
    return {pores, over * pores};
}

} // namespace listric::fluid
