#pragma once

#include "dem/base/water_level.hpp"
#include "dem/event.hpp"

namespace listric::fluid {

/// Ground above the water is dry: discs there weigh what they weigh in air, by a push. Comes after
/// deposition, so that new discs have their weight, and after the excess pressure of the same
/// moment, whose pushes it goes on top of.
class DryGround : public dem::Event {
public:
    /// @param buoyancy  N per kg of a disc under water
    /// @param on_top    excess pressure has set the discs' pushes
    DryGround(const dem::WaterLevel& level, double buoyancy, const dem::Schedule& schedule,
              bool on_top);

    void begin(dem::State& state) override;
    bool start(dem::State& state, const dem::RigidBase& base) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

private:
    dem::WaterLevel level_;
    double buoyancy_;
    bool on_top_;
};

} // namespace listric::fluid
