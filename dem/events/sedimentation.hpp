#pragma once

#include "dem/base/target_line.hpp"
#include "dem/beds.hpp"
#include "dem/event.hpp"

namespace listric::dem {

/// Deposition and erosion to a target line [paper, "Syn-rift sedimentation"; Table 1].
struct SedimentationParameters {
    double interval = 5.0e4;              ///< time between sedimentations, Delta t_s, a
    double level = 0.0;                   ///< of the target, above the original surface, m
    std::vector<TargetStage> target = {}; ///< the target line; empty: the level
    double surface_porosity = 0.5;        ///< Phi_ini
    double grain_density = 2600.0;        ///< density at zero porosity, kg/m^3
    Material material = {};               ///< of sediment discs: bonded by healing only
};

/// Density of a disc as it is laid down, kg/m^3: its pores are those between the grains and, once
/// discs are packed under gravity, those between the discs.
double disc_density(const SedimentationParameters& parameters);

/// Greatest height, m, up to which the surface is filled at and behind the breakaway, x <= 0. Above
/// 0 a backstop holds sediment there; level ground (DetachmentParameters::footwall_top) would be
/// covered close to the hanging wall alone, and sediment fall off its end.
/// @param end  extension at the end, m, of a motion without stages
double highest_fill_behind_breakaway(const SedimentationParameters& parameters,
                                     const Motion& motion, const Calendar& calendar, double end);

/// Adapts the surface to the target line, whatever its shape.
///
/// Discs that lie wholly above it are removed with their bonds. The space between surface and line
/// is filled with unbonded discs of a new stratum: each falls at a random place, rolls down over
/// discs and base to where two of them hold it, and stays if it is not above the line. It touches
/// without overlap, so nothing is shocked. The ledger has what came and what went.
class Sedimentation : public Event {
public:
    Sedimentation(const SedimentationParameters& parameters, double radius_ratio,
                  const Calendar& calendar, Beds beds = {});

    bool apply(State& state, const RigidBase& base) override;

private:
    SedimentationParameters parameters_;
    Target target_;
    double radius_ratio_;
    Beds beds_;
};

} // namespace listric::dem
