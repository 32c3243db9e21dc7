#pragma once

#include "dem/event.hpp"

namespace listric::dem {

/// Gives sediment the friction that the stages of a motion say, where one begins that says it.
class StageChange : public Event {
public:
    explicit StageChange(const Motion& motion);

    double next_due() const override;
    void begin(State& state) override;
    bool apply(State& state, const RigidBase& base) override;

private:
    std::vector<MotionStage> changes_; ///< stages from the second on that say a friction
    std::optional<double> first_;      ///< of the first
};

} // namespace listric::dem
