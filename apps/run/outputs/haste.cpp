#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "dem/events/strain.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace listric {

using namespace measures;

namespace {

/// Says once what makes the results doubtful, when a whole window of strain is known or at the end.
class Haste : public Output {
public:
    Part part() const override { return Part::measures; }

    void window(RunView& run) override {
        const double known =
            std::min(dem::strain_window, run.target()) - run.simulation.tolerance();
        if (has_warned_ || run.extension() < known)
            return;
        const Measures& measures = run.measured();
        if (measures.quasi_static.value_or(true))
            return;
        has_warned_ = true;
        run.log.say(fmt::format(
            "warning: too fast to be quasi-static: unbalanced forces are {:.2g} of contact forces "
            "(at most {:g}), the inertial number is {:.2g} (at most {:g}); a smaller "
            "extension.speed_m_per_s than {:g} is needed, or more discs",
            measures.unbalanced_ratio_mean, greatest_unbalanced_ratio, measures.inertial_number,
            greatest_inertial_number, run.scene.extension.speed));
    }

    void finish(RunView& run) override { window(run); }

private:
    bool has_warned_ = false;
};

} // namespace

std::unique_ptr<Output> outputs::haste(const RunView&) { return std::make_unique<Haste>(); }

} // namespace listric
