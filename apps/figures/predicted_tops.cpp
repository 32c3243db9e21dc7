#include "apps/figures/predicted_tops.hpp"

#include "apps/measures/basin/kinematics.hpp"

namespace listric {

using namespace measures;

std::optional<PredictedTops> predict_tops(const Observation& now, const Measures& measures) {
    if (!measures.inclined_shear_angle)
        return std::nullopt;
    const double angle = *measures.inclined_shear_angle;
    const dem::Chain& detachment = now.parts.base.surfaces.front().chain;
    const double extension = now.state.clock.extension.m, right = now.right_end();
    return PredictedTops{angle, inclined_shear_top(detachment, extension, angle, right),
                         normals_top(detachment, extension, right)};
}

} // namespace listric
