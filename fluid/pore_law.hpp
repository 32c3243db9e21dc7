#pragma once

namespace listric::fluid {

// Mud as a function of what has pressed it. Its state is the void ratio e = phi / (1 - phi), pores
// over grains, so that grains, which are kept, count once.

/// How permeability depends on porosity phi.
enum class PermeabilityLaw {
    kozeny_carman, ///< in proportion to phi^3 / (1 - phi)^2
    constant,
    mudstone ///< of clay fraction and void ratio [Yang & Aplin 2010, eq. 6]
};

/// Permeability of sediment.
struct Permeability {
    PermeabilityLaw law = PermeabilityLaw::kozeny_carman;
    double at_fifth = 1e-18;    ///< at a porosity of 0.2, m^2; that of `constant` at any
    double clay_fraction = 0.4; ///< of `mudstone`: mass of particles below 2 micrometres, over all
};

/// Factors of permeability between two weakened discs, and between a weakened and a sound one.
struct FaultFactors {
    double along = 1.0, across = 1.0;

    bool matter() const { return along != 1.0 || across != 1.0; }
};

/// How water flows through sediment of a kind.
struct SedimentFlow {
    Permeability permeability = {};
    double ratio = 1.0; ///< permeability along bedding over that across
    FaultFactors faults = {};
};

/// Permeability across bedding, m^2. Porosities below 0.005 count as that.
double permeability(const Permeability& mud, double porosity);

/// How sediment compacts: phi = phi_0 exp(-c z) at depth z of a column whose water is at rest
/// [Baldwin & Butler 1985]. With the weight of grains in water it is a law of effective stress.
struct PoreLaw {
    double surface_porosity = 0.5;    ///< phi_0
    double decay = 4e-4;              ///< c, 1/m
    double grain_weight = 15402.0;    ///< of grains less that of water as large, N/m^3
    double compressibility = 4.4e-10; ///< of water, 1/Pa
    double rebound = 0.1;             ///< slope of e over stress where that falls, over the slope
                                      ///< where it rises
};

/// Porosity at a depth of a column whose water is at rest.
double porosity_at(const PoreLaw& law, double depth);

/// Height of the grains above a depth of that column, z - phi_0 / c (1 - exp(-c z)), m.
double grains_at(const PoreLaw& law, double depth);

/// Depth of that column at which so much of grains, m, lies above: the inverse of grains_at().
double equivalent_depth(const PoreLaw& law, double grains);

/// Pores over what is kept, grains of sediment or the volume of rock, and the derivative by excess
/// pressure, 1/Pa.
struct VoidRatio {
    double value = 0.0, slope = 0.0;
};

/// Void ratio under so much of grains, m, with excess pressure u, Pa, of sediment whose greatest
/// equivalent depth so far is `burial`, m.
VoidRatio void_ratio(const PoreLaw& law, double grains, double burial, double excess_pressure);

/// Rock before extension that water flows through. It is stiff: its volume stays, and its pores
/// close by phi_0 exp(-compressibility s / phi_0), where s is effective stress beyond that at the
/// start, and open by -compressibility s where it is less.
struct PorousRock {
    double porosity = 0.1;          ///< phi_0
    double compressibility = 1e-10; ///< of its volume by effective stress, 1/Pa
    SedimentFlow flow = {.permeability = {.law = PermeabilityLaw::constant}};
};

/// Pores over its volume under so much more stress than at the start, Pa, with excess pressure.
VoidRatio rock_pores(const PorousRock& rock, double load, double excess_pressure);

/// Equivalent depth under grains and excess pressure, m.
double burial_under(const PoreLaw& law, double grains, double excess_pressure);

} // namespace listric::fluid
