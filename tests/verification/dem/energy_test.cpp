// Energy goes where the account says:
//   work of boundary and gravity
//     = kinetic + strain energy + loss by slip, by local damping and by breaking bonds.
// The account is kept from the states before and after each cycle, with its own contact law. With
// half-step velocities v- and v+ around the positions x, leapfrog keeps
//   1/2 m v- v+ + 1/2 K x^2
// of linear springs exactly, and the work of any force F at x is F (v- + v+) / 2 dt. What remains
// is of first order in dt: contacts that close or open and bonds that break within a step.
//
// Without losses, the usual energy 1/2 m ((v- + v+) / 2)^2 + 1/2 K x^2 of a bonded lattice swings
// by O(dt^2).

#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"
#include "tests/verification/shaken_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::energy_test {

using namespace dem;
namespace {

using namespace support;

class Energy : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, Energy, every_cycle(), cycle_name);

/// Keeps the account of a box with a conveyor for a floor and sides that move. One material, one
/// friction.
class Account {
public:
    Account(const RigidBase& base, const CyclePhysics& physics) : base_(base), physics_(physics) {}

    double kinetic = 0.0, strain = 0.0;               ///< now, J
    double boundary = 0.0, gravity = 0.0;             ///< work since the start, J
    double slip = 0.0, damping = 0.0, breaking = 0.0; ///< losses, J
    std::int64_t broken = 0;

    double residual() const {
        return kinetic + strain + slip + damping + breaking - boundary - gravity;
    }

    /// Enters the cycle from `a` to `b`, which has the same contact table.
    void enter(const State& a, const State& b) {
        const double dt = a.clock.time_step;
        const Material& m = a.materials[basement];
        const double K = 0.5 * m.normal_stiffness, Ks = 0.5 * m.shear_stiffness;
        const ConstDiscColumns d = disc_columns(a), after = disc_columns(b);
        const ConstContactColumns c = contact_columns(a), c_after = contact_columns(b);
        const ConstBaseContactColumns w = base_contact_columns(a),
                                      w_after = base_contact_columns(b);
        kinetic = strain = gravity = 0.0;
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const double inertia = 0.5 * d.mass[i] * square(d.radius[i]);
            kinetic += 0.5 * d.mass[i] * (d.vx[i] * after.vx[i] + d.vy[i] * after.vy[i]) +
                       0.5 * inertia * d.spin[i] * after.spin[i];
            gravity += d.mass[i] * physics_.gravity * (d.start_y[i] - d.y[i]);
            damping += damping_loss(d.mass[i], d.vx[i], after.vx[i]) +
                       damping_loss(d.mass[i], d.vy[i], after.vy[i]) +
                       damping_loss(inertia, d.spin[i], after.spin[i]);
        }
        for (std::size_t k = 0; k < c.first.size(); ++k) {
            const auto i = static_cast<std::size_t>(c.first[k]);
            const auto j = static_cast<std::size_t>(c.second[k]);
            const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
            const double distance = std::hypot(dx, dy), nx = dx / distance, ny = dy / distance;
            const double overlap = d.radius[i] + d.radius[j] - distance;
            const double slip_rate = (d.vy[j] - d.vy[i]) * nx - (d.vx[j] - d.vx[i]) * ny -
                                     (d.radius[i] - 0.5 * overlap) * d.spin[i] -
                                     (d.radius[j] - 0.5 * overlap) * d.spin[j];
            const bool breaks = c.bonded[k] && !c_after.bonded[k];
            broken += breaks;
            enter_contact(K, Ks, overlap, slip_rate * dt, c.shear_force[k], c_after.shear_force[k],
                          c_after.bonded[k], breaks);
        }
        const double speed = base_.motion.speed_at(a.clock.time());
        for (std::size_t k = 0; k < w.disc.size(); ++k) {
            const auto i = static_cast<std::size_t>(w.disc[k]);
            const Surface& s = base_.surfaces[static_cast<std::size_t>(w.surface[k])];
            const auto foot = nearest(s, a.clock.extension.m, {d.x[i], d.y[i]});
            if (!foot)
                continue;
            const double nx = foot->normal.x, ny = foot->normal.y;
            const double wall_vx = speed * (s.translation.x + s.conveyor * ny);
            const double wall_vy = speed * (s.translation.y - s.conveyor * nx);
            const double slip_rate =
                (d.vy[i] - wall_vy) * nx - (d.vx[i] - wall_vx) * ny - d.spin[i] * foot->distance;
            const double overlap = d.radius[i] - foot->distance;
            enter_contact(K, Ks, overlap, slip_rate * dt, w.shear_force[k], w_after.shear_force[k],
                          false, false);
            const double normal = K * std::max(overlap, 0.0), shear = w_after.shear_force[k];
            boundary +=
                dt * ((normal * nx - shear * ny) * wall_vx + (normal * ny + shear * nx) * wall_vy);
        }
    }

private:
    void enter_contact(double K, double Ks, double overlap, double slipped, double shear_before,
                       double shear_after, bool bonded, bool breaks) {
        if (overlap > 0.0 || bonded)
            strain += 0.5 * K * square(overlap) + 0.5 * square(shear_after) / Ks;
        const double trial = shear_before - Ks * slipped;
        if (breaks) {
            // Energy that the springs lose.
            breaking += 0.5 * (square(trial) - square(shear_after)) / Ks +
                        (overlap > 0.0 ? 0.0 : 0.5 * K * square(overlap));
        } else if (trial != shear_after && (overlap > 0.0 || shear_before != 0.0)) {
            // Slip at the mean of the forces before and after.
            slip += 0.5 * (shear_before + shear_after) * (trial - shear_after) / Ks;
        }
    }

    /// The damping force takes its share of the force, whose sign is that of what is left of it.
    double damping_loss(double inertia, double before, double after) const {
        const double a = physics_.damping;
        if (before == 0.0)
            return 0.0;
        const double net = inertia * (after - before); // times dt
        const double with_motion = std::copysign(1.0, net) * std::copysign(1.0, before);
        const double force = net / (1.0 - a * with_motion);
        return (force - net) * 0.5 * (before + after);
    }

    RigidBase base_;
    CyclePhysics physics_;
};

bool searched(const State& a, const State& b) {
    const ConstDiscColumns c = disc_columns(a), d = disc_columns(b);
    return !std::ranges::equal(c.searched_x, d.searched_x) ||
           !std::ranges::equal(c.searched_y, d.searched_y) ||
           a.searched_extension != b.searched_extension;
}

/// A bonded block falls on a rough conveyor, which carries it against a wall that comes closer.
struct Fall {
    RigidBase base = box(30.0, 1e3, 0.3);
    State state;

    explicit Fall(double step_share) {
        constexpr double r = 1.0;
        base.surfaces[1].conveyor = 1.0;
        base.surfaces[2].translation = {-1.0, 0.0};
        base.motion = {0.5, 0.1};
        base.material = {1e9, 0.4e9, 0.3, true};
        std::vector<Disc> discs = hexagonal(8, 8, r);
        for (Disc& disc : discs) {
            disc.x += 10.0 * r;
            disc.y += 3.0 * r;
        }
        state = make_state(discs, base.material);
        bond_all(state, base, 2e6f);
        state.clock.time_step =
            stable_time_step(disc_columns(state).mass[0], base.material, 0.0, step_share);
    }
};

constexpr double fall_seconds = 1.5;

Account account_of_fall(double damping, const Execution& execution) {
    Fall fall(0.02);
    Account account(fall.base, {damping, 9.81});
    while (fall.state.clock.time() < fall_seconds) {
        State before = fall.state;
        advance(fall.state, fall.base, {damping, 9.81}, 1, execution);
        if (searched(before, fall.state)) // the tables' rows were others
            update_contacts(before, fall.base);
        account.enter(before, fall.state);
    }
    return account;
}

TEST_P(Energy, IsAccountedFor) {
    // 1e-3 with steps of 0.02 of the limit, in proportion to the step.
    for (double a : {0.0, 0.3}) {
        const Account account = account_of_fall(a, GetParam());
        const double work = account.boundary + account.gravity;
        EXPECT_NEAR(account.residual(), 0.0, 1e-3 * work) << a;
        // Every entry counts.
        EXPECT_GT(account.boundary, 0.02 * work);
        EXPECT_GT(account.slip, 0.02 * work);
        EXPECT_GT(account.breaking, 0.01 * work);
        EXPECT_GT(account.kinetic, 0.01 * work);
        EXPECT_GE(account.damping, a * work);
        EXPECT_GT(account.broken, 20);
    }
}

TEST(EnergyAccount, AgreesWithTheOneKeptHere) {
    // The two accounts enter a force at the ends of a step and at its middle: 1e-3, as above. The
    // program's own closes to 1e-5, and in proportion at steps 40 times as long.
    for (double a : {0.0, 0.3}) {
        const Account account = account_of_fall(a, {1, Cycle::plain});
        for (double step_share : {0.02, 0.8}) {
            Fall fall(step_share);
            EnergyFlows flows;
            Execution execution;
            execution.energy = &flows;
            const StoredEnergy start = stored_energy(fall.state, fall.base, 9.81);
            advance(fall.state, fall.base, {a, 9.81},
                    static_cast<std::int64_t>(fall_seconds / fall.state.clock.time_step) + 1,
                    execution);
            const StoredEnergy end = stored_energy(fall.state, fall.base, 9.81);
            const double gravity = start.potential - end.potential;
            const double work = flows.boundary_work + gravity;
            EXPECT_NEAR(end.motion_and_strain() - start.motion_and_strain() + flows.friction +
                            flows.damping + flows.bond_breaking + flows.stepping,
                        work, (step_share > 0.02 ? 4e-4 : 1e-5) * work);
            if (step_share > 0.02)
                continue;
            EXPECT_NEAR(flows.boundary_work, account.boundary, 1e-3 * work);
            EXPECT_NEAR(gravity, account.gravity, 1e-3 * work);
            EXPECT_NEAR(flows.friction, account.slip, 1e-3 * work);
            EXPECT_NEAR(flows.damping, account.damping, 1e-3 * work);
            EXPECT_NEAR(flows.bond_breaking, account.breaking, 1e-3 * work);
        }
    }
}

/// Energy that leapfrog keeps, and the usual energy.
struct LatticeEnergy {
    double kept, usual; ///< J
};

/// Energies in the next cycle.
LatticeEnergy next_energy(State& state, const Execution& execution) {
    const State before = state;
    advance(state, {}, {0.0, 0.0}, 1, execution);
    Account account({}, {0.0, 0.0});
    account.enter(before, state);
    const ConstDiscColumns d = disc_columns(before), after = disc_columns(std::as_const(state));
    double kinetic = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        kinetic += 0.125 * d.mass[i] *
                   (square(d.vx[i] + after.vx[i]) + square(d.vy[i] + after.vy[i]) +
                    0.5 * square(d.radius[i] * (d.spin[i] + after.spin[i])));
    return {account.kinetic + account.strain, kinetic + account.strain};
}

TEST_P(Energy, SwingsByTheSquareOfTheStep) {
    // Root mean square over the same time with steps of 0.2, 0.1 and 0.05 of the limit. The next
    // order is up to (omega dt)^2 / 4 of it, 0.04: a ratio of 4 to 2 %.
    const auto swing = [&](double share) {
        State state = shaken(share);
        const auto steps = std::llround(800.0 / share);
        double sum = 0.0, squares = 0.0;
        for (std::int64_t n = 0; n < steps; ++n) {
            const double energy = next_energy(state, GetParam()).usual;
            sum += energy;
            squares += energy * energy;
        }
        const double mean = sum / static_cast<double>(steps);
        return std::sqrt(squares / static_cast<double>(steps) - mean * mean) / mean;
    };
    const double coarse = swing(0.2), middle = swing(0.1), fine = swing(0.05);
    EXPECT_NEAR(coarse / middle, 4.0, 0.08);
    EXPECT_NEAR(middle / fine, 4.0, 0.08);
}

} // namespace
} // namespace listric::energy_test
