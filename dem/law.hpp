#pragma once

#include "dem/material.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace listric::dem {

/// Constants of the contact law for a pair of materials. Single precision halves the traffic of the
/// cycle and is ample for properties; forces and positions are double.
struct ContactParameters {
    float normal_stiffness;           ///< K, N/m
    float shear_stiffness_times_step; ///< K_s dt, N s/m
    float friction;
    float rolling_friction = 0.0f; ///< mu_r; no more than friction
};

/// Two linear springs in series (PFC's linear contact model). Not inline: g++ 12 drops a rounding
/// to single precision that it can see being widened again, and the two cycles would differ.
ContactParameters contact_parameters(const Material& a, const Material& b, double time_step);

/// Constants for a disc and a wall, whose friction is the disc's: surface_force() knows the wall's.
ContactParameters base_contact_parameters(const Material& wall, const Material& disc,
                                          double time_step);

/// Contact parameters of every pair of a state's materials.
class PairParameters {
public:
    PairParameters(std::span<const Material> materials, double time_step);
    const ContactParameters& operator()(std::uint8_t a, std::uint8_t b) const {
        return table_[a * count_ + b];
    }

private:
    std::size_t count_;
    std::vector<ContactParameters> table_;
};

/// Linear contact with a breakable contact bond and Coulomb friction, PFC2D's rules.
///
/// @param overlap    sum of radii less distance, m; negative across a gap
/// @param slip_rate  relative tangential velocity of the contact point, m/s
/// @param shear_force in: before this cycle; out: after it, N
/// @param bonded     in and out: a bond breaks when its tensile or shear strength is exceeded
/// @return normal force, N, positive in compression
///
/// While bonded there is neither slip nor resistance to rotation. A tensile break removes both
/// forces; a shear break leaves what friction can carry.
inline double contact_force(double overlap, double slip_rate, const ContactParameters& p,
                            float tensile_strength, float shear_strength, double& shear_force,
                            std::uint8_t& bonded) {
    const double normal = static_cast<double>(p.normal_stiffness) * overlap;
    const double shear =
        shear_force - static_cast<double>(p.shear_stiffness_times_step) * slip_rate;
    if (bonded && -normal <= static_cast<double>(tensile_strength) &&
        std::abs(shear) <= static_cast<double>(shear_strength)) {
        shear_force = shear;
        return normal;
    }
    bonded = 0;
    if (overlap <= 0.0) {
        shear_force = 0.0;
        return 0.0;
    }
    const double limit = static_cast<double>(p.friction) * normal;
    // Zero without friction, never -0, so that a frictionless cycle need not know the velocities.
    shear_force = limit > 0.0 ? std::min(std::max(shear, -limit), limit) : 0.0;
    return normal;
}

/// Stiffness of a contact against rolling, times the step, N m s: PFC's rolling resistance linear
/// model. The lever r_i r_j / (r_i + r_j) is the disc's radius on a plane.
inline double rolling_stiffness_times_step(const ContactParameters& p, double lever) {
    return static_cast<double>(p.shear_stiffness_times_step) * (lever * lever);
}

/// Moment of an unbonded contact against rolling, on the second disc, N m: a spring that yields
/// where the normal force acts mu_r times the lever off the centre [Iwashita & Oda 1998; Ai et al.
/// 2011], so that a disc rests on a slope whose tangent is mu_r.
/// @param before     the cycle, N m
/// @param roll_rate  spin of the second disc less the first's, rad/s
/// @param normal     force, N; none where discs are apart or bonded
inline double rolling_moment(double before, double roll_rate, double lever, double normal,
                             const ContactParameters& p) {
    const double turned = before - rolling_stiffness_times_step(p, lever) * roll_rate;
    const double limit = static_cast<double>(p.rolling_friction) * lever * normal;
    return limit > 0.0 ? std::min(std::max(turned, -limit), limit) : 0.0;
}

/// The force less local damping: a share of its size that opposes the velocity, so that steady
/// motion is free [Itasca 1999, as cited by the paper]. What is at rest is not damped. A force in N
/// with a velocity in m/s, or a moment in N m with a spin in 1/s; `damping` is the share.
inline double damped(double force, double velocity, double damping) {
    return velocity == 0.0 ? force : force - std::copysign(damping * std::abs(force), velocity);
}

} // namespace listric::dem
