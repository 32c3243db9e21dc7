#pragma once

#include "dem/calendar.hpp"
#include "dem/event.hpp"

#include <vector>

namespace listric::effects::stage {

/// Measures of whether the steps of pauses come to rest, that the report judges.
inline constexpr const char* unsettled_steps = "unsettled_steps";
inline constexpr const char* step_unrest = "step_unrest_m";

/// Looks whether the steps of pauses come to rest: rock from before the rift, in the last quarter
/// of a step, by columns `step_x` and `step_y`. A base that moves as prescribed takes rock along
/// all the time; what it does is no unrest.
class StepRecord final : public dem::Observer {
public:
    /// A step rests if in its last quarter rock moves by less than this, mean of discs, mean radii.
    static constexpr double rest = 0.01;

    StepRecord(const dem::Calendar& calendar, bool base_is_prescribed);

    dem::Travel next_due() const override;
    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    double steps() const { return memory.get<double>("steps")[0]; }
    double unsettled() const { return memory.get<double>("unsettled")[0]; }
    double last() const { return memory.get<double>("last_m")[0]; } ///< motion, m

private:
    std::vector<dem::Travel> due_; ///< the last quarter of a step and its end, in turn
    bool base_is_prescribed_;
};

} // namespace listric::effects::stage
