#include "apps/figures/window_strain.hpp"

#include "dem/events/strain.hpp"

namespace listric {

std::vector<double> window_strain(const Observation& now) {
    const auto* const strain = dem::find<dem::Strain>(now.events);
    if (!strain || strain->applied == 0)
        return dem::shear_strain(now.state);
    const auto values = now.state.discs.get<double>("window_strain");
    return {values.begin(), values.end()};
}

} // namespace listric
