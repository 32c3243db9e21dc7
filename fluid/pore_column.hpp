#pragma once

#include "fluid/pore_law.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace listric::fluid {

/// A column of mud on a floor that sinks, filled up to a fixed level with fresh mud in every step:
/// finite volumes by layers of a step, with the laws and the solver of PoreFluid. What a section of
/// discs would be without flow to the sides.
struct MudColumn {
    PoreLaw law = {};
    Permeability mud = {};
    double viscosity = 5e-4; ///< Pa s
    double fracture_ratio = 0.9;
    /// Sediment of a kind, up to a time, s.
    struct Bed {
        double until;
        PoreLaw law;
        Permeability mud;
    };
    std::vector<Bed> beds = {}; ///< one after the other; none: all is as above
};

/// A layer at the end.
struct MudLayer {
    double depth = 0.0;           ///< of its middle below the top, m
    double grains_above = 0.0;    ///< and in half of itself, m
    double excess_pressure = 0.0; ///< Pa
    double porosity = 0.0;
    double overpressure_ratio = 0.0; ///< excess pressure over the weight of grains in water
};

/// A column after it has sunk.
struct SunkColumn {
    std::vector<MudLayer> layers;                               ///< from the floor up
    double grains = 0.0;                                        ///< height of all grains, m
    double came = 0.0, surface = 0.0, vented = 0.0, left = 0.0; ///< water, m
    int most_steps = 0;                                         ///< of Newton's method
    bool converged = true;

    /// Values of the layers about a depth, linear between their middles.
    MudLayer at(double depth) const;
};

/// @param floor  depth below the level after every step, m; where it rises nothing is laid down
/// @param step   s
SunkColumn sink(const MudColumn& column, std::span<const double> floor, double step);

/// Depths of a floor that sinks by `distance` in as many steps.
std::vector<double> steady_floor(double distance, std::size_t steps);

/// A column that has sunk steadily, as layers and steps become ever thinner: extrapolated from two
/// numbers of steps, since errors halve with the steps.
struct SteadyColumn {
    SunkColumn coarse, fine; ///< of some steps, and twice as many
    double fracture_ratio = 0.9;

    MudLayer at(double depth) const;
};

SteadyColumn sink_steadily(const MudColumn& column, double distance, double seconds);

/// Bounds of Gibson's number: water is at rest below, and above hardly any leaves but through
/// fractures.
inline constexpr double gibson_at_rest = 0.1, gibson_undrained = 100.0;

/// The time factor of Gibson (1958) for mud laid down at a rate, m/s, for a time, s: squared rate
/// times time over the coefficient of consolidation at porosity 0.2. Far below 1 pressure is
/// hydrostatic, far above 1 mud is undrained.
double gibson_number(const MudColumn& column, double rate, double time);

} // namespace listric::fluid
