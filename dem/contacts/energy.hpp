#pragma once

#include "dem/base.hpp"
#include "dem/law.hpp"
#include "dem/state.hpp"

#include <algorithm>

namespace listric::dem {

// Where the work goes, J per metre of thickness:
//   boundary, base and gravity work + work of pushes, events and radii
//     = change of kinetic and strain energy + losses by friction, damping, breaking bonds and
//     steps.
//
// Leapfrog knows positions x_n at whole steps and velocities v_{n+1/2} between them. A force F_n
// changes m v^2 / 2 by exactly F_n (v_{n-1/2} + v_{n+1/2}) / 2 dt, so that is its work. Summed over
// the steps, the work of a spring F = -K x is the change of K x_n x_{n+1} / 2, not of K x_n^2 / 2;
// that of gravity the change of m g (y_n + y_{n+1}) / 2. With strain energy and potential defined
// so, at the moment between x_n and x_{n+1} at which the velocities are known, the account of
// linear springs, slip, damping and bonds that break closes to round-off for any time step.
//
// A contact that closes or opens within a step is the one real error of the steps: with overlaps
// U_{n-1} and U_n of different sign and forces N = K max(U, 0), (N_{n-1} U_n - N_n U_{n-1}) / 2 is
// lost, or won where it opens. As damped discs part more slowly than they met, more is lost than
// won; it is entered as what it is. What remains as residual are normals that turn within a step,
// of third order, and round-off.
//
// A base that deforms has an account of its own: elastic energy, virtual and reference loads. What
// passes between the two is the work of the contact forces on the moving nodes, base_work.

/// Sums of cycles.
struct EnergyFlows {
    double boundary_work = 0.0; ///< of base and walls on the discs, J/m
    double base_work = 0.0;     ///< of a base that deforms, by the motion of its nodes, J/m
    double friction = 0.0;      ///< lost by slip and by rolling, J/m
    double damping = 0.0;       ///< lost by local damping, J/m
    double bond_breaking = 0.0; ///< loss of the springs' energy when bonds broke, J/m
    double stepping = 0.0;      ///< lost by contacts that close or open within a step, J/m
    double radii = 0.0;         ///< work of radii that change with every cycle, J/m

    EnergyFlows& operator+=(const EnergyFlows& other) {
        boundary_work += other.boundary_work;
        base_work += other.base_work;
        friction += other.friction;
        damping += other.damping;
        bond_breaking += other.bond_breaking;
        stepping += other.stepping;
        radii += other.radii;
        return *this;
    }
};

/// Energy of a state.
struct StoredEnergy {
    double kinetic = 0.0;                           ///< J/m
    double normal_strain = 0.0, shear_strain = 0.0; ///< of contacts; rolling is shear, J/m
    double potential = 0.0;                         ///< of the discs' weight, against y = 0, J/m
    double push_potential = 0.0;                    ///< of their pushes, against the origin, J/m

    double motion_and_strain() const { return kinetic + normal_strain + shear_strain; }
};

/// Loss by a normal spring over a step: overlaps, m, and those that its force stands for, which
/// differ across a gap. Zero where force and overlap stay in proportion.
inline double normal_loss(double pressed_before, double before, double pressed, double now,
                          const ContactParameters& p) {
    return 0.5 * static_cast<double>(p.normal_stiffness) *
           (pressed_before * now - pressed * before);
}

/// Energies between the last cycle and the next. `gravity` in m/s^2.
StoredEnergy stored_energy(const State& state, const RigidBase& base, double gravity);

/// Loss of a spring that slip has brought from `before` not to `trial`, but to `after`, N; or
/// rolling, N m. Stiffness times step, N s/m or N m s.
inline double slip_loss(double before, double trial, double after, double stiffness_times_step,
                        double time_step) {
    if (trial == after)
        return 0.0;
    return 0.5 * (before + after) * (trial - after) * time_step / stiffness_times_step;
}

} // namespace listric::dem
