#include "dem/events/stage_change.hpp"

#include "dem/base/rest.hpp"
#include "dem/columns.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace listric::dem {

namespace {

bool changes(const MotionStage& one) { return one.sediment_friction || rests(one); }

} // namespace

bool StageChange::is_needed(const Motion& motion) {
    return std::ranges::any_of(motion.stages, changes);
}

StageChange::StageChange(const Motion& motion) : Event("stage", never) {
    if (motion.stages.empty())
        return;
    first_ = motion.stages.front().sediment_friction;
    std::copy_if(motion.stages.begin() + 1, motion.stages.end(), std::back_inserter(changes_),
                 changes);
}

Travel StageChange::next_due() const {
    const auto next = static_cast<std::size_t>(applied);
    return next < changes_.size() ? changes_[next].start
                                  : Travel(std::numeric_limits<double>::infinity());
}

void StageChange::begin(State& state) {
    if (first_)
        state.materials[sediment].friction = *first_;
}

bool StageChange::apply(State& state, const RigidBase&) {
    const MotionStage& now = changes_[static_cast<std::size_t>(applied)];
    if (now.sediment_friction)
        state.materials[sediment].friction = *now.sediment_friction;
    if (rests(now) && state.discs.has(columns::mean_vx))
        for (const auto& mean : {columns::mean_vx, columns::mean_vy})
            std::ranges::fill(state.discs.get(mean), 0.0f);
    return false;
}

} // namespace listric::dem
