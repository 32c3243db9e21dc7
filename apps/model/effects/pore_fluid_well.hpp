#pragma once

#include "apps/scene/parameters/effect.hpp"
#include "fluid/pore_fluid.hpp"

#include <vector>

namespace listric::effects {

/// The fluid of a run; null where its water is at rest.
const fluid::PoreFluid* fluid_in(const Observation& now);

/// State of the fluid in a disc of sediment or of porous rock.
struct WetDisc {
    std::size_t row = 0;
    double x = 0.0, y = 0.0;
    double depth = 0.0;           ///< below the ground with what is pending on it, m
    double age = 0.0;             ///< since it was laid down; of rock since the start, a
    double volume = 0.0;          ///< of its mud, or of rock, m^2
    double water = 0.0;           ///< m^2
    double excess_pressure = 0.0; ///< Pa
    double weight = 0.0;          ///< of grains in water above, at the last solution, Pa
    double porosity = 0.0, normal_porosity = 0.0;
    double permeability = 0.0; ///< across bedding, m^2

    double ratio() const { return weight > 0.0 ? excess_pressure / weight : 0.0; }
};

/// Discs of sediment, or of porous rock, that the last solution knew.
std::vector<WetDisc> wet_discs(const Observation& now);
std::vector<WetDisc> wet_rock(const Observation& now);

/// Place where sediment is deepest, m.
double depocentre(const std::vector<WetDisc>& wet);

/// Means over the discs of a well, 1 km to either side, in steps of 250 m or two diameters.
struct WellPoint {
    double x = 0.0, y = 0.0, depth = 0.0; ///< depth below the ground, m
    double pressure = 0.0;                ///< of water, Pa
    double excess = 0.0;                  ///< over that of water at rest, Pa
    double effective = 0.0;               ///< vertical stress of the grains, Pa
    double ratio = 0.0, porosity = 0.0, normal_porosity = 0.0;
    double permeability = 0.0; ///< m^2
    double mud_weight = 0.0;   ///< density of a mud that balances the pressure, kg/m3
    double total = 0.0;        ///< vertical stress of grains and water, Pa
    double at_rest = 0.0;      ///< pressure of water at rest, Pa
    double fracture = 0.0;     ///< pressure at which fractures open, Pa
    double age = 0.0;          ///< since it was laid down, a
};

/// Through sediment, from the ground down.
std::vector<WellPoint> well_at(const Observation& now, double x);

/// Through porous rock, too, by depth.
std::vector<WellPoint> deep_well_at(const Observation& now, double x);

/// How wells are named, placed and written.
MeasuredWell pore_well();

} // namespace listric::effects
