#pragma once

#include "dem/event.hpp"

namespace listric::dem {

/// Changes what the stages of a motion say where they begin: the friction of sediment, and, where
/// the wall comes to rest, the discs' memory of their mean motion. It would fade in its own time,
/// in which damping drags discs on.
class StageChange : public Event {
public:
    explicit StageChange(const Motion& motion);

    /// Whether a motion has a stage that changes something.
    static bool is_needed(const Motion& motion);

    Travel next_due() const override;
    void begin(State& state) override;
    bool apply(State& state, const RigidBase& base) override;

private:
    std::vector<MotionStage> changes_; ///< stages from the second on that change something
    std::optional<double> first_;      ///< friction in the first
};

} // namespace listric::dem
