#pragma once

#include "dem/base.hpp"
#include "dem/material.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace listric::dem {

/// Columns that weakened discs need; they exist only while fault weakening is on.
struct WeakenedColumns {
    std::span<double> scanned_x, scanned_y; ///< where the last scan found the disc, m
    std::span<double> rock_radius;          ///< radius without enlargement, m; 0: not weakened
    std::span<double> rock_area;            ///< power cell before weakening, m^2; 0: unknown
    std::span<double> correction;           ///< of the enlargement, from the volume error
};

/// Rows of the discs that are weakened.
std::vector<std::int32_t> weak_rows(const State& state);

void add_weakened_columns(State& state);
WeakenedColumns weakened_columns(State& state);

/// Enlargement of a weak disc's radius that leaves the spacing of discs as it was before weakening:
/// 1 + q / (1 + 0.42 q), q = mean stress over contact stiffness (fit to confined shear zones).
double enlargement(double mean_stress, const Material& weak_material);

/// Vertical stress at the centre of each disc of the rows from the weight of all that lies above
/// it, rock and sediment, Pa: masses in a column that fades out over five mean radii to both sides,
/// per width of it that is between the leftmost and the rightmost disc; less the disc's own
/// `excess_pressure`, where there is that column.
std::vector<double> overburden(const State& state, std::span<const std::int32_t> rows,
                               double gravity);

/// Sum of power-cell areas of weakened discs less what it was before weakening, m^2.
double weakened_volume_change(const State& state, const RigidBase& base);

} // namespace listric::dem
