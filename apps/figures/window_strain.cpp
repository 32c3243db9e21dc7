#include "apps/figures/window_strain.hpp"

#include "dem/events/strain.hpp"

#include <cstddef>
#include <limits>

namespace listric {

std::vector<double> window_strain(const Observation& now) {
    const auto* const strain = dem::find<dem::Strain>(now.events);
    std::vector<double> values;
    if (strain && strain->applied > 0) {
        const auto last = now.state.discs.get<double>("window_strain");
        values.assign(last.begin(), last.end());
    } else {
        values = dem::shear_strain(now.state);
    }
    // Sediment that has been there for a window has moved, if ever so little.
    const dem::ConstDiscColumns d = dem::disc_columns(now.state);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (d.stratum[i] > 0 && values[i] == 0.0)
            values[i] = std::numeric_limits<double>::quiet_NaN();
    return values;
}

} // namespace listric
