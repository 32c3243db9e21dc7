#pragma once

#include "apps/measures/strata/horizons.hpp"
#include "apps/measures/strata/line_misfit.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/measure.hpp"
#include "dem/state.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
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

/// Value of one in summary.json under a name; null: none.
struct ObservedField {
    std::string_view name, unit, label, doc;
    nlohmann::ordered_json (*value)(const ObservedHorizon& horizon);
};
std::span<const ObservedField> observed_fields();

inline constexpr Quantity observed_horizons{
    "observed", "", "picked horizons",
    "picked horizons beside the model's tops; with `[observed]` only"};
inline constexpr Quantity detachment_misfit{
    "detachment_misfit_m", "m", "misfit of the fitted detachment",
    "largest distance of a picked fault's points from the arcs and lines fitted to them; only with "
    "`detachment.csv` or `svg`"};

/// Compares every picked horizon with the top that was deposited at its age, or without an age with
/// the nearest of all. The age is before the end of the scene's extension: the section as it is.
/// @param horizons  of that state, the oldest first
std::vector<ObservedHorizon> compare_horizons(const Scene& scene, const dem::State& state,
                                              const std::vector<measures::Horizon>& horizons);

} // namespace listric::archive
