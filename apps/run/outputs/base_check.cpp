#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"

#include <fmt/format.h>

namespace listric {

namespace {

/// How far off the base is: solves for it once more on a finer mesh.
class BaseCheck : public Output {
public:
    Part part() const override { return Part::base; }

    void finish(RunView& run) override {
        const auto fine = run.footwall ? run.footwall->check(run.state()) : std::nullopt;
        if (!fine)
            return;
        append(run.numbers, {{"base_elements_difference", fine->elements},
                             {"base_resolved_difference", fine->base}});
        run.log.say(fmt::format("the base under the last window's mean forces, solved again with "
                                "{} unknowns: the run's elements are {:.2f} % off, its base "
                                "{:.2f} %",
                                fine->unknowns, 100.0 * fine->elements, 100.0 * fine->base));
    }
};

} // namespace

std::unique_ptr<Output> outputs::base_check(const RunView& run) {
    return has_effect(run.scene, "elastic_base") ? std::make_unique<BaseCheck>() : nullptr;
}

} // namespace listric
