#pragma once

#include "apps/measures/measures.hpp"
#include "apps/measures/polyline.hpp"
#include "apps/scene/parameters/effect.hpp"

#include <optional>

namespace listric {

/// Tops that kinematic constructions predict over the detachment as it was at the start, m, y up.
struct PredictedTops {
    double angle = 0.0; ///< of inclined shear that fits best, degrees from the vertical
    measures::Polyline inclined_shear, normals;
};

/// None where no angle fits.
std::optional<PredictedTops> predict_tops(const Observation& now,
                                          const measures::Measures& measures);

} // namespace listric
