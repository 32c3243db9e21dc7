#pragma once

#include "dem/base.hpp"
#include "dem/energy.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <stdexcept>

namespace listric::dem {

/// Physics of the cycle beyond the contact law.
struct CyclePhysics {
    /// Local non-viscous damping: F_d = -damping |F| sign(v) per component. Where the base
    /// stretches, v is relative to it: else all that moves with it would be dragged back.
    double damping = 0.7;
    double gravity = 0.0; ///< m/s^2, downward
    /// Time over which a disc's velocity is averaged (exponentially), s, to damp what departs from
    /// that mean; 0: to damp velocity itself. What sinks steadily is else held up by damping as if
    /// it weighed less, up to `damping` times the unbalanced force on it. The state needs the
    /// columns of add_mean_velocities().
    double averaging_time = 0.0;
};

/// Gives discs the memory of damping relative to their mean motion.
void add_mean_velocities(State& state);

/// What answers to the loads on the nodes of a base that deforms.
class BaseResponse {
public:
    virtual ~BaseResponse() = default;

    /// Sets the nodes' velocities for the next `interval` cycles from the loads of the last, which
    /// it sets to zero. The state's nodes and memory are as they are now; its discs, contacts and
    /// clock may be those of earlier cycles. Called by one thread.
    virtual void respond(State& state, const Clock& clock) = 0;

    int interval = 1; ///< cycles between responses, at multiples of it
};

/// The numerics went wrong: what() names the disc and the place.
struct NumericalFailure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The plain cycle is the scalar specification of the fast one; best is the fast one where the
/// machine has the registers for it.
enum class Cycle { best, plain, fast };

/// How the cycle is computed; the result is the same to the last bit.
struct Execution {
    int threads = 1;
    Cycle cycle = Cycle::best;
    /// Adds up energies, if given: then the cycle is the plain one, on one thread.
    EnergyFlows* energy = nullptr;
};

/// Advances by `cycles` cycles, searching neighbours whenever discs may have come closer than the
/// list knows. One cycle: contact forces from positions and the velocities half a step earlier;
/// then each disc's motion. Forces on a disc are added in the order base contacts, then contacts
/// by row. Nodes of a base that deforms collect the loads by row of the base contacts, then
/// `response` sets their velocities; without one they keep them. Throws NumericalFailure if a disc
/// runs away.
void advance(State& state, const RigidBase& base, const CyclePhysics& physics, std::int64_t cycles,
             const Execution& execution = {}, BaseResponse* response = nullptr);

/// Largest stable time step times `safety`, s, of discs of mass `mass` (kg) with six contacts each:
/// sqrt(2 m / (k (1 + damping))), k the greater of 3 (K + K_s), for translation, and 12 K_s, for
/// rotation (inertia m r^2 / 2). The highest eigenvalue of a network of such contacts is at most
/// 2 k / m, since (a - b)^2 <= 2 a^2 + 2 b^2 in every contact's energy, and the integration is
/// stable below 2 / omega. In the fastest mode velocities change sign with every step, so that
/// local damping always adds to the springs' force.
double stable_time_step(double mass, const Material& material, double damping, double safety);

} // namespace listric::dem
