#pragma once

// Names of effects' measures that other code takes or looks for in summary.json; the measures are
// declared in the effects' descriptions.

#include <string_view>

namespace listric::effects {

inline constexpr const char* weak_fraction = "weak_fraction";
inline constexpr std::string_view volume_error_fraction = "volume_error_fraction";
inline constexpr const char* sediment_stress_ratio = "sediment_stress_ratio";

// Names of the elastic base's measures.
inline constexpr const char* footwall_uplift = "footwall_uplift_m";
inline constexpr const char* breakaway_shift = "breakaway_shift_m";
inline constexpr const char* base_deflection = "base_deflection_max_m";
inline constexpr const char* interface_force_error = "interface_force_error";
inline constexpr const char* interface_moment_error = "interface_moment_error";
inline constexpr const char* interface_work_error = "interface_work_error";
inline constexpr const char* base_reaction_error = "base_reaction_error";
inline constexpr const char* net_wall_load = "net_wall_load_n_per_m";
inline constexpr const char* weight_change = "weight_change_n_per_m";
inline constexpr const char* net_wall_load_error = "net_wall_load_error";
inline constexpr const char* strong_rock_strain = "strong_rock_strain_max";
inline constexpr const char* relaxed_rock_strain = "relaxed_rock_strain_max";
inline constexpr const char* rock_rotation = "rock_rotation_max_deg";
inline constexpr const char* beyond_byerlee = "beyond_byerlee_m2";
inline constexpr const char* base_elements_difference = "base_elements_difference";
inline constexpr const char* base_resolved_difference = "base_resolved_difference";

inline constexpr const char* heat_balance_error = "heat_balance_error";

// Names of the water's measures.
inline constexpr const char* water_error = "water_error";
inline constexpr const char* fluid_closure = "fluid_closure";

} // namespace listric::effects
