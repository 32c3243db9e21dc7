#pragma once

#include "dem/base/target_line.hpp"
#include "dem/calendar.hpp"
#include "dem/cycle_physics.hpp"

namespace listric::dem {

enum class FaultSense { normal, reverse };

/// Motion of the base that is known beforehand: uplift, subsidence, tilt, or a fault that slips.
struct BaseMotionParameters {
    std::vector<TargetStage> uplift = {}; ///< upward displacement by x, at times, m
    std::vector<TargetStage> shift = {};  ///< rightward, m; may be empty
    /// Where a fault of the basement meets the base of the cover, m; none: no fault slips.
    std::optional<double> fault_x = {};
    double fault_dip = 60.0; ///< to the right, degrees
    FaultSense fault_sense = FaultSense::normal;
    std::optional<double> fault_slip = {}; ///< at the end of a run without stages, m
    std::optional<double> friction = {};   ///< of a base that no other table describes
};

/// Nodes along a chain, with a node where pieces meet, two for each face about `face` m long.
std::vector<Point> detachment_nodes(const Chain& chain, double face);

/// Moves the nodes of the base as prescribed, relative to where they are at the start. Between
/// answers nodes run evenly, and each answer aims at the place itself, so that nothing accumulates.
class BaseMotion final : public BaseResponse {
public:
    BaseMotion(const BaseMotionParameters& parameters, const Motion& motion,
               const Calendar& calendar);

    void respond(State& state, const Clock& clock) override;

    Point displacement(double x, double time) const; ///< m at a time, a

private:
    Target uplift_, shift_;
    Motion motion_;
    Calendar calendar_;
};

/// Greatest speed of a node over the extension's speed: a stage's change of displacement over the
/// extension during it.
double greatest_base_speed(const BaseMotionParameters& parameters, const Calendar& calendar);

} // namespace listric::dem
