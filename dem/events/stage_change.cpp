#include "dem/events/stage_change.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace listric::dem {

StageChange::StageChange(const Motion& motion) : Event("stage", never) {
    if (motion.stages.empty())
        return;
    first_ = motion.stages.front().sediment_friction;
    std::copy_if(motion.stages.begin() + 1, motion.stages.end(), std::back_inserter(changes_),
                 [](const MotionStage& one) { return one.sediment_friction.has_value(); });
}

double StageChange::next_due() const {
    const auto next = static_cast<std::size_t>(applied);
    return next < changes_.size() ? changes_[next].start : std::numeric_limits<double>::infinity();
}

void StageChange::begin(State& state) {
    if (first_)
        state.materials[sediment].friction = *first_;
}

bool StageChange::apply(State& state, const RigidBase&) {
    state.materials[sediment].friction =
        *changes_[static_cast<std::size_t>(applied)].sediment_friction;
    return false;
}

} // namespace listric::dem
