#pragma once

#include "apps/studies/sweep/sweep_effects.hpp"

#include <span>
#include <string>

namespace listric {

/// An effect is clear where chance alone gives one like it in fewer than one of twenty sweeps.
inline constexpr double clear_p = 0.05;

/// effects.csv: measure, term, effect, standard_error, degrees_of_freedom, p, low_95, high_95; from
/// standard_error on empty where nothing is known of chance.
std::string effects_csv(std::span<const SweepEffect> effects);

/// Effects as text: each parameter's own, and of two together those that are clear.
std::string effects_text(std::span<const SweepEffect> effects);

/// Warning of too few seeds; empty from three seeds on.
std::string warning_of_few(int seeds);

} // namespace listric
