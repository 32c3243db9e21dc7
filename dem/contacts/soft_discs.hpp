#pragma once

#include "dem/base.hpp"
#include "dem/material.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace listric::dem {

/// Columns that weakened and other soft discs need; they exist only where there can be some.
struct EnlargedColumns {
    std::span<double> rock_radius; ///< radius without enlargement, m; 0: not enlarged
    std::span<double> rock_area;   ///< power cell before enlargement, m^2; 0: unknown
    std::span<double> correction;  ///< of the enlargement, from the volume error
};

/// Rows of the discs that are weakened.
std::vector<std::int32_t> weak_rows(const State& state);

/// Rows of the discs that are enlarged: of weakened rock and of soft layers.
std::vector<std::int32_t> soft_rows(const State& state);

void add_enlarged_columns(State& state);
EnlargedColumns enlarged_columns(State& state);

/// Enlarges discs of soft material for the first time, as much as what lies above them asks for:
/// enlarged at once, a soft disc carries the load that the stiff one carried.
void enlarge(State& state, const RigidBase& base, std::span<const std::int32_t> rows,
             double mean_stress_ratio, double gravity);

/// Makes discs weakened rock: soft, enlarged, without bonds.
/// @param rows  ascending, of rock that can be weakened
void weaken(State& state, const RigidBase& base, std::span<const std::int32_t> rows,
            double mean_stress_ratio, double gravity);

/// Enlargement of a weak disc's radius that leaves the spacing of discs as it was before weakening:
/// 1 + q / (1 + 0.42 q), q = mean stress over contact stiffness (fit to confined shear zones).
double enlargement(double mean_stress, const Material& weak_material);

/// Vertical stress at the centre of each disc of the rows from the weight of all that lies above
/// it, rock and sediment, Pa: masses in a column that fades out over five mean radii to both sides,
/// per width of it that is between the leftmost and the rightmost disc; less the disc's own
/// `excess_pressure`, where there is that column.
std::vector<double> overburden(const State& state, std::span<const std::int32_t> rows,
                               double gravity);

/// How the volume of soft discs is kept.
struct VolumeKeeping {
    double zone = 0.0;               ///< radius in which the error of a volume is taken, m
    double mean_stress_ratio = 0.75; ///< mean stress over the weight above
    double largest_change = 0.05;    ///< largest relative change of a radius at once
    bool corrects = true;            ///< takes errors of volume back; else radii follow the load
};

/// Adjusts the radii of soft discs once, see PropertyUpdate. Returns the error that it found, the
/// change of the volume of all of them together over their volume when stiff; none if there are no
/// such discs.
std::optional<double> keep_volume(State& state, const RigidBase& base, const VolumeKeeping& how,
                                  double gravity);

/// Sum of power-cell areas of weakened discs less what it was before weakening, m^2.
double weakened_volume_change(const State& state, const RigidBase& base);

} // namespace listric::dem
