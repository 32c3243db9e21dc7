#pragma once

#include "dem/event.hpp"
#include "dem/events/fault_weakening.hpp"

namespace listric::dem {

/// Adjusts radius and density of discs of weakened rock and of soft layers, which interpenetrate
/// under load, such that the volume of the rock and its mass are conserved [paper, "Enhanced DE
/// models"].
///
/// The radius follows the mean stress expected below what lies above the disc; what that leaves of
/// a change of volume, measured by power cells around the disc, is taken back step by step.
/// Feedback from the disc's surroundings lags behind where a zone changes steadily, so that a
/// common factor takes back the change of all zones together.
///
/// In a pause radii follow the load alone. What the feedback takes back is made by motion; at rest
/// it would go on from step to step, shake zones loose and let what lies on them sink.
class PropertyUpdate : public Event {
public:
    PropertyUpdate(const FaultWeakeningParameters& parameters, const Calendar& calendar,
                   double gravity);

    /// An update of soft layers alone, where no fault is weakened.
    PropertyUpdate(const Calendar& calendar, double gravity);

    bool apply(State& state, const RigidBase& base) override;

private:
    FaultWeakeningParameters parameters_;
    double gravity_; ///< m/s^2
};

} // namespace listric::dem
