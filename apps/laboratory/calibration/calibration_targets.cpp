#include "apps/laboratory/calibration/calibration_targets.hpp"

#include "apps/support/error.hpp"

#include <fmt/format.h>

namespace listric {

namespace {

constexpr double steepest = 0.9; ///< envelope that no disc friction reaches: 0.83 at 10

} // namespace

void CalibrationTargets::check() const {
    const auto refuse = [](const char* option, double value, const char* allowed) {
        throw UsageError(fmt::format("{} {}: allowed: {}", option, value, allowed));
    };
    if (!(young >= 1e6 && young <= 1e13))
        refuse("--young", young, "1e6 to 1e13 Pa");
    if (!(poisson > 0.0 && poisson < 0.5))
        refuse("--poisson", poisson, "above 0, below 0.5 (plane strain)");
    // nu_2D = nu / (1 - nu): a two-dimensional material reaches 0.5 when the rock has 1/3.
    if (poisson >= 1.0 / 3.0)
        refuse("--poisson", poisson,
               "below 1/3, which is 0.5 in 2D terms: contacts give less, however soft in shear");
    if (!byerlee && !(friction > 0.0 && friction <= steepest))
        refuse("--friction", friction,
               "above 0, at most 0.9: round discs roll, whatever their own friction");
    if (!byerlee && !(cohesion >= 0.0 && cohesion <= 1e9))
        refuse("--cohesion", cohesion, "0 to 1e9 Pa");
    if (bulk_friction && !(*bulk_friction > 0.0 && *bulk_friction <= 1.0))
        refuse("--bulk-friction", *bulk_friction, "above 0, at most 1");
}

} // namespace listric
