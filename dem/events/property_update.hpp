#pragma once

#include "dem/event.hpp"
#include "dem/events/fault_weakening.hpp"

#include <span>

namespace listric::dem {

/// Adjusts radius and density of weakened discs, which interpenetrate under load, such that the
/// volume of the rock and its mass are conserved [paper, "Enhanced DE models"].
///
/// The radius follows the mean stress expected at the disc's depth; what that leaves of a change
/// of volume, measured by power cells around the disc, is taken back step by step.
class PropertyUpdate : public Event {
public:
    PropertyUpdate(const FaultWeakeningParameters& parameters, double extension_rate,
                   double gravity, double density);

    bool apply(State& state, const RigidBase& base) override;

private:
    FaultWeakeningParameters parameters_;
    double overburden_;
};

/// Columns that weakened discs need; they exist only while fault weakening is on.
struct WeakenedColumns {
    std::span<double> scanned_x, scanned_y; ///< where the last scan found the disc, m
    std::span<double> rock_radius;          ///< radius without enlargement, m; 0: not weakened
    std::span<double> rock_area;            ///< power cell before weakening, m^2; 0: unknown
    std::span<double> correction;           ///< of the enlargement, from the volume error
};

void add_weakened_columns(State& state);
WeakenedColumns weakened_columns(State& state);

/// Enlargement of a weak disc's radius that leaves the spacing of discs as it was before weakening:
/// 1 + q / (1 + 0.42 q), q = mean stress over contact stiffness (fit to confined shear zones).
double enlargement(double mean_stress, const Material& weak_material);

/// Sum of power-cell areas of weakened discs less what it was before weakening, m^2.
double weakened_volume_change(const State& state, const RigidBase& base);

} // namespace listric::dem
