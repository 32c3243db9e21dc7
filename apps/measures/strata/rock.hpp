#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/measures/setting.hpp"
#include "apps/support/measure.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace listric::measures {

// Changes of rock and sediment by faults and burial.

/// Names of rocks, by what rocks() returns.
inline constexpr const char* rock_names[] = {"basement", "weak basement", "sediment",
                                             "weak sediment"};

/// Which rock each disc is of.
std::vector<std::uint32_t> rocks(const dem::State& state);

/// Weak share, by area, of the pre-rift rock and of the sediment: basement_weak_fraction,
/// sediment_weak_fraction.
NamedNumbers weak_shares(const dem::State& state);

/// Share of the sediment's discs, by area, that are weak and further than `distance` m from every
/// trace. None without sediment.
std::optional<double> weak_off_faults(const dem::State& state, std::span<const Fault> faults,
                                      double distance);

/// Whether sediment lies as it should, the younger on top and none above the surface that it is
/// adapted to: superposition_fraction, discs_above_target.
NamedNumbers measure_layering(const dem::State& state, const dem::TargetLine& surface);

/// Porosity of sediment, from mass and radius of its discs, beside that expected in its depth below
/// the surface: porosity_error, porosity_off_fraction.
/// @param settled  age from which on sediment counts, m of travel: a layer is buried under itself
///                 when it is laid down, and still compacts
NamedNumbers measure_porosity(const dem::State& state, const Sediment& sediment, double settled);

/// All of these that have a meaning in the setting.
NamedNumbers measure_rock(const Setting& setting, const dem::State& state);

std::span<const Quantity> rock_quantities();

} // namespace listric::measures
