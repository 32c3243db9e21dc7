#pragma once

#include "apps/measures/horizons.hpp"
#include "apps/measures/line_misfit.hpp"
#include "apps/scene/scene.hpp"
#include "dem/state.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric::archive {

/// A picked horizon beside the model's.
struct ObservedHorizon {
    std::string name;
    std::optional<int> stratum; ///< whose top it is compared with
    std::optional<measures::LineMisfit> misfit;
    std::size_t points = 0; ///< picked
    std::string objection;  ///< why it is compared with nothing, if it is not
};

/// Compares every picked horizon with the top that was deposited at its age, or without an age with
/// the nearest of all. The age is before the end of the scene's extension: the section as it is.
/// @param horizons  of that state, the oldest first
std::vector<ObservedHorizon> compare_horizons(const Scene& scene, const dem::State& state,
                                              const std::vector<measures::Horizon>& horizons);

} // namespace listric::archive
