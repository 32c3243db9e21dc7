#pragma once

#include "coupling/footwall_loads.hpp"
#include "dem/event.hpp"
#include "fem/footwall.hpp"

namespace listric::coupling {

/// Steps in which a footwall relaxes: every 25 m of travel, and as pauses that go by steps ask.
dem::Schedule creep_schedule(const dem::Calendar& calendar);

/// Lets rock of the footwall relax. The base answers to the discs as it will at the end of the step
/// that has begun: with what of its stiffness is left by then, and under the stress that is left
/// from before (fem::Load::stress), which is one more load elsewhere. At the step's end the field
/// below is recovered from the nodes, and its stress is what the next step begins with. A step of
/// another length has another stiffness, to which footwall, modes and unit loads are made anew.
class Creep : public dem::Event {
public:
    /// @param end  of the run: no step begins there
    Creep(fem::Footwall& footwall, ElasticBase& base, FootwallLoads& loads,
          const dem::Calendar& calendar, dem::Travel end);

    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    /// Takes the stiffness of the step that a state is in. Throws fem::FootwallError.
    void go_on_with(const dem::State& state);

private:
    void take_step(double seconds);

    fem::Footwall* footwall_;
    ElasticBase* base_;
    FootwallLoads* loads_;
    dem::Travel end_;
    double step_; ///< that the footwall has, s
};

} // namespace listric::coupling
