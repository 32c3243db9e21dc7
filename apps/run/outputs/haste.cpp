#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "dem/events/strain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace listric {

using namespace measures;

std::optional<Output> outputs::haste(const RunView&) {
    // Says once what makes the results doubtful: when a whole window of strain is known, or at the
    // end.
    const auto warn = [has_warned = std::make_shared<bool>(false)](RunView& run) {
        const dem::Travel known = std::min(dem::Travel(dem::strain_window), run.target());
        if (*has_warned || !has_come_to(run.travel(), known, run.simulation.tolerance()))
            return;
        const Measures& measures = run.measured();
        if (measures.quasi_static.value_or(true))
            return;
        *has_warned = true;
        run.log.say(fmt::format(
            "warning: too fast to be quasi-static: unbalanced forces are {:.2g} of contact forces "
            "(at most {:g}), the inertial number is {:.2g} (at most {:g}); a smaller "
            "extension.speed_m_per_s than {:g} is needed, or more discs",
            *measures.unbalanced_ratio_mean, greatest_unbalanced_ratio, measures.inertial_number,
            greatest_inertial_number, run.scene.extension.speed));
    };
    return Output{.part = Part::measures, .window = warn, .finish = warn};
}

} // namespace listric
