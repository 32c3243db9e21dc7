#pragma once

#include "dem/base/target_line.hpp"
#include "dem/calendar.hpp"
#include "dem/state.hpp"

#include <vector>

namespace listric::dem {

/// Height of the water's surface above the original one, which a run may change.
struct WaterLevel {
    Target heights{0.0};     ///< a level line, m
    Calendar calendar = 1.0; ///< of the heights

    double at(const State& state) const; ///< now, m
};

/// Weight that each disc has and water of that level does not carry, N: of what is above it. Discs
/// weigh in every cycle what they weigh in water; this comes on top.
/// @param buoyancy  of what is below the level, N per kg of the disc
std::vector<double> dry_weights(const State& state, double level, double buoyancy);

} // namespace listric::dem
