#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <stdexcept>

namespace listric::dem {

// Physics that the plain and the fast cycle share.

/// Physics of the cycle beyond the contact law.
struct CyclePhysics {
    /// Local non-viscous damping: F_d = -damping |F| sign(v) per component. Where the base
    /// stretches, v is relative to the thinning that goes with it: else all that moves with it
    /// would be dragged back.
    double damping = 0.7;
    double gravity = 0.0; ///< m/s^2, downward
    /// Time over which a disc's velocity is averaged (exponentially), s, to damp what departs from
    /// that mean; 0: to damp velocity itself, as PFC does. What sinks steadily is else held up by
    /// damping as if it weighed less, up to `damping` times the unbalanced force on it. The state
    /// needs the columns of add_mean_velocities().
    double averaging_time = 0.0;
};

/// Gives discs the memory of damping relative to their mean motion: `mean_vx` and `mean_vy`, m/s.
/// Single precision: what it rounds away is 4e-5 of the mean at 150 s, and the sign of v - mean is
/// all that it is for.
void add_mean_velocities(State& state);

/// Cycles between samples of a velocity for its mean, at multiples of it. They are a thousandth of
/// the averaging time; a sample every cycle would cost the memory traffic of writing it.
inline constexpr std::int64_t averaging_interval = 16;

/// Response to the loads on the nodes of a base that deforms.
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

/// An event would leave no disc: no other time step helps.
struct NothingLeft : NumericalFailure {
    using NumericalFailure::NumericalFailure;
};

/// Largest stable time step times `safety`, s, of discs of mass `mass` (kg) with six contacts each:
/// sqrt(2 m / (k (1 + damping))), k the greater of 3 (K + K_s), for translation, and 12 K_s, for
/// rotation (inertia m r^2 / 2). The highest eigenvalue of a network of such contacts is at most
/// 2 k / m, since (a - b)^2 <= 2 a^2 + 2 b^2 in every contact's energy, and the integration is
/// stable below 2 / omega. In the fastest mode velocities change sign with every step, so that
/// local damping always adds to the springs' force.
double stable_time_step(double mass, const Material& material, double damping, double safety);

/// Throws NumericalFailure if a disc is several radii from its searched place, or nowhere: it is
/// out of control. Quick where the state's bound of displacements rules it out.
void refuse_runaways(const State& state);
void refuse_displaced(const State& state); ///< whatever the bound

} // namespace listric::dem
