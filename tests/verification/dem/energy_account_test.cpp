// The program's account of energy, dem/contacts/energy.hpp, against problems with a known answer
// and against the account that energy_test.cpp keeps with a contact law of its own.

#include "dem/contacts/contacts.hpp"
#include "dem/contacts/energy.hpp"
#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

namespace listric::energy_account_test {

using namespace dem;
namespace {

using namespace support;

/// Advances with an account.
struct Accounted {
    State state;
    RigidBase base;
    CyclePhysics physics;
    EnergyFlows flows = {};
    StoredEnergy start = {};
    BaseResponse* response = nullptr;

    Accounted(State s, RigidBase b, const CyclePhysics& p)
        : state(std::move(s)), base(std::move(b)), physics(p) {
        find_contacts(state, base);
        start = stored();
    }

    void pass(std::int64_t cycles) {
        Execution execution;
        execution.energy = &flows;
        advance(state, base, physics, cycles, execution, response);
    }

    StoredEnergy stored() const { return stored_energy(state, base, physics.gravity); }
    double gravity_work() const { return start.potential - stored().potential; }
    double residual() const {
        return stored().motion_and_strain() - start.motion_and_strain() + flows.friction +
               flows.damping + flows.bond_breaking + flows.stepping - flows.boundary_work -
               flows.base_work - gravity_work();
    }
};

constexpr double r = 1.0, g = 9.81;
const Material soft{1e9, 0.4e9, 0.5, true};

/// A disc without friction on its neighbours, at the height where a plane carries it.
State resting(double friction) {
    State state = make_state({{0.0, 0.0, r}}, Material{1e9, 0.4e9, friction, true});
    const DiscColumns d = disc_columns(state);
    d.y[0] = d.start_y[0] = r - d.mass[0] * g / contact_stiffness(soft);
    // It slides and does not roll.
    state.clock.time_step = stable_time_step(d.mass[0], soft, 0.0, 0.5);
    return state;
}

RigidBase plane(double friction, double conveyor, double speed) {
    RigidBase base;
    base.surfaces = {{"plane", {line({-1e4, 0.0}, {1e4, 0.0})}, friction, conveyor, {}}};
    base.material = soft;
    base.motion = {speed, 0.0};
    return base;
}

TEST(EnergyAccount, SlidingDiscLosesByFriction) {
    // A disc thrown with v slips until it rolls with 2/3 v: a third of m v^2 / 2 is lost, two
    // thirds stay, in translation and rotation. Loaded contact springs hold m g^2 / K.
    constexpr double v = 3.0, friction = 0.2;
    Accounted a(resting(friction), plane(friction, 0.0, 0.0), {0.0, g});
    disc_columns(a.state).vx[0] = v;
    a.start = a.stored();
    const double m = disc_columns(a.state).mass[0], energy = 0.5 * m * v * v;
    a.pass(static_cast<std::int64_t>(2.0 * v / (friction * g) / a.state.clock.time_step));
    EXPECT_NEAR(a.flows.friction, energy / 3.0, 1e-3 * energy);
    EXPECT_NEAR(a.stored().kinetic, energy / 1.5, 1e-3 * energy);
    EXPECT_EQ(a.flows.damping, 0.0);
    EXPECT_NEAR(a.residual(), 0.0, 1e-9 * energy);
}

TEST(EnergyAccount, ConveyorWorksOnWhatItTakesAlong) {
    // A disc at rest on a conveyor of speed V rolls up to V / 3 while it slips with friction mu:
    // the force mu m g acts for V / (3 mu g) through V: work m V^2 / 3, half of which is lost.
    constexpr double speed = 3.0, friction = 0.2;
    Accounted a(resting(friction), plane(friction, 1.0, speed), {0.0, g});
    const double m = disc_columns(a.state).mass[0], work = m * speed * speed / 3.0;
    a.pass(static_cast<std::int64_t>(2.0 * speed / (friction * g) / a.state.clock.time_step));
    EXPECT_NEAR(a.flows.boundary_work, work, 2e-3 * work);
    EXPECT_NEAR(a.flows.friction, 0.5 * work, 2e-3 * work);
    EXPECT_NEAR(a.stored().kinetic, 0.5 * work, 2e-3 * work);
    EXPECT_NEAR(a.residual(), 0.0, 1e-9 * work);
}

TEST(EnergyAccount, DampingTakesItsShareOfAFall) {
    // The damping force is 0.7 of the weight, against the motion: it takes 0.7 m g h, after the
    // first cycle, in which the disc is at rest.
    State state = make_state({{0.0, 100.0, r}}, soft);
    state.clock.time_step = 1e-3;
    Accounted a(std::move(state), plane(0.0, 0.0, 0.0), {0.7, g});
    a.pass(1);
    a.flows = {};
    a.start = a.stored();
    a.pass(2000);
    const double fallen = a.gravity_work();
    EXPECT_GT(fallen, 0.0);
    EXPECT_NEAR(a.flows.damping, 0.7 * fallen, 1e-12 * fallen);
    EXPECT_NEAR(a.stored().kinetic - a.start.kinetic, 0.3 * fallen, 1e-12 * fallen);
}

TEST(EnergyAccount, BouncingDiscComesToRest) {
    // All that gravity did is lost to damping, but for m^2 g^2 / (2 K) in the contact and what the
    // steps lose where it closes and opens, which is of first order.
    State state = make_state({{0.0, 3.0 * r, r}}, soft);
    const double m = disc_columns(state).mass[0], K = contact_stiffness(soft);
    state.clock.time_step = stable_time_step(m, soft, 0.0, 0.02);
    Accounted a(std::move(state), plane(0.0, 0.0, 0.0), {0.7, g});
    a.pass(static_cast<std::int64_t>(10.0 / a.state.clock.time_step));
    const double held = 0.5 * m * g * m * g / K;
    EXPECT_LT(a.stored().kinetic, 1e-9 * a.gravity_work());
    EXPECT_NEAR(a.stored().normal_strain, held, 1e-6 * held);
    EXPECT_NEAR(a.flows.damping, a.gravity_work() - held, 1e-2 * a.gravity_work());
    EXPECT_NEAR(a.residual(), 0.0, 1e-9 * a.gravity_work());
}

TEST(EnergyAccount, BreakingBondLosesWhatItHeld) {
    // Two discs drift apart until their bond breaks at T: T^2 / (2 K), within a step's stretch. The
    // balance closes at any step.
    State state = make_state(row(2, r), soft);
    const double m = disc_columns(state).mass[0], K = contact_stiffness(soft);
    constexpr double T = 1e6, v = 1.0;
    state.clock.time_step = stable_time_step(m, soft, 0.0, 0.01);
    bond_all(state, {}, static_cast<float>(T));
    disc_columns(state).vx[1] = v;
    Accounted a(std::move(state), {}, {0.0, 0.0});
    const double total = a.stored().kinetic;
    a.pass(2000);
    ASSERT_EQ(contact_columns(a.state).bonded[0], 0);
    const double held = 0.5 * T * T / K;
    EXPECT_NEAR(a.flows.bond_breaking, held, 0.05 * held);
    EXPECT_EQ(a.flows.friction, 0.0);
    EXPECT_EQ(a.stored().normal_strain, 0.0);
    EXPECT_NEAR(a.residual(), 0.0, 1e-12 * total);
}

TEST(EnergyAccount, ClosesForSpringsAtAnyStep) {
    // A bonded lattice that vibrates at 0.9 of the limit: round-off, and normals that turn, of the
    // order of the strain squared.
    State state = make_state(hexagonal(5, 5, r), soft);
    bond_all(state, {});
    const DiscColumns d = disc_columns(state);
    Random random(2);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        d.vx[i] = 1e-5 * random.between(-1.0, 1.0);
        d.vy[i] = 1e-5 * random.between(-1.0, 1.0);
        d.spin[i] = 1e-5 * random.between(-1.0, 1.0);
    }
    state.clock.time_step = stable_time_step(d.mass[0], soft, 0.3, 0.9);
    Accounted a(std::move(state), {}, {0.3, 0.0});
    const double total = a.stored().motion_and_strain();
    a.pass(300);
    EXPECT_GT(a.flows.damping, 0.5 * total);
    EXPECT_NEAR(a.residual(), 0.0, 1e-6 * total);
}

/// The heap of fast_cycle_test.cpp: contacts form, slip and break.
Accounted heap() {
    RigidBase base = box(40.0 * r, 1e3, 0.3);
    std::vector<Disc> discs = cloud(15, 10, r, 7);
    for (Disc& disc : discs) {
        disc.x += 3.0 * r;
        disc.y += 2.0 * r;
    }
    State state = make_state(discs, soft);
    bond_all(state, base, 1e6f);
    state.clock.time_step = stable_time_step(0.6 * disc_columns(state).mass[0], soft, 0.3, 0.3);
    base.surfaces[1].conveyor = 1.0;
    base.surfaces[2].translation = {-1.0, 0.0};
    base.motion = {1.0, 0.1};
    base.material = soft;
    return Accounted(std::move(state), base, {0.3, g});
}

TEST(EnergyAccount, StretchingBaseWorksOnWhatItTakesAlong) {
    // A disc at rest at x on a base that stretches at the rate s rolls up to s x / 3, as on a
    // conveyor of the speed there.
    constexpr double x = 3000.0, length = 1e4, base_speed = 10.0, friction = 0.2;
    RigidBase base = plane(friction, 0.0, base_speed);
    base.surfaces[0].stretched_length = length;
    Accounted a(resting(friction), base, {0.0, g});
    disc_columns(a.state).x[0] = x;
    find_contacts(a.state, a.base);
    a.start = a.stored();
    const double speed = base_speed * x / length;
    const double m = disc_columns(a.state).mass[0], work = m * speed * speed / 3.0;
    a.pass(static_cast<std::int64_t>(2.0 * speed / (friction * g) / a.state.clock.time_step));
    // It moves on where the base is faster, which itself slows down as it gets longer.
    EXPECT_NEAR(a.flows.boundary_work, work, 5e-3 * work);
    EXPECT_NEAR(a.residual(), 0.0, 1e-7 * work);
}

/// The heap on a wall of elements that alone moves, with the backstop at its start.
Accounted heap_on_nodes() {
    Accounted a = heap();
    a.base.surfaces[1].conveyor = 0.0;
    a.base.surfaces[2].translation = {};
    const std::vector<double> x{-5.0 * r, 5.0 * r, 15.0 * r, 30.0 * r, 50.0 * r}, y(5, 0.0);
    add_base_nodes(a.state, x, y);
    a.base.surfaces[0].follows = Follows::breakaway;
    a.base.surfaces[1].follows = Follows::nodes;
    find_contacts(a.state, a.base);
    a.pass(20000); // the cloud falls together
    a.flows = {};
    a.start = a.stored();
    return a;
}

TEST(EnergyAccount, LiftingBaseWorksAgainstWeight) {
    // An even lift of the whole heap: its weight times the way.
    Accounted a = heap_on_nodes();
    a.base.surfaces[0].friction = a.base.surfaces[2].friction = 0.0;
    a.pass(5000);
    a.flows = {};
    a.start = a.stored();
    for (double& vy : base_node_columns(a.state).vy)
        vy = 0.1;
    a.pass(20000);
    const double way = base_node_columns(a.state).uy[0];
    double mass = 0.0;
    for (const double m : disc_columns(a.state).mass)
        mass += m;
    EXPECT_NEAR(a.flows.base_work, mass * g * way, 2e-2 * mass * g * way);
    EXPECT_NEAR(a.gravity_work(), -mass * g * way, 2e-2 * mass * g * way);
    EXPECT_NEAR(a.residual(), 0.0, 1e-4 * a.flows.base_work);
}

/// Shakes the nodes, each differently.
struct Shaking final : BaseResponse {
    void respond(State& state, const Clock& clock) override {
        const BaseNodeColumns nodes = base_node_columns(state);
        for (std::size_t k = 0; k < nodes.x.size(); ++k) {
            const double phase = 3.0 * clock.time() + static_cast<double>(k);
            nodes.vx[k] = 0.3 * std::sin(phase);
            nodes.vy[k] = 0.5 * std::sin(1.7 * phase);
        }
    }
};

TEST(EnergyAccount, ClosesOnABaseThatDeforms) {
    Shaking shaking;
    shaking.interval = 3;
    Accounted a = heap_on_nodes();
    a.response = &shaking;
    a.pass(20000);
    EXPECT_NEAR(a.residual(), 0.0, 1e-3 * std::abs(a.flows.base_work));
}

TEST(EnergyAccount, ClosesForRelativeDamping) {
    Accounted a = heap_on_nodes();
    a.physics.averaging_time = 1.0;
    add_mean_velocities(a.state);
    Shaking shaking;
    a.response = &shaking;
    a.pass(20000);
    EXPECT_GT(a.flows.damping, 0.0);
    EXPECT_NEAR(a.residual(), 0.0, 1e-3 * std::abs(a.flows.base_work));
}

TEST(EnergyAccount, ChangesNothing) {
    Accounted a = heap();
    State plain = a.state, fast = a.state;
    a.pass(3000);
    advance(plain, a.base, a.physics, 3000, {1, Cycle::plain});
    advance(fast, a.base, a.physics, 3000, {2, fast_cycle()});
    EXPECT_EQ(hash(a.state), hash(plain));
    EXPECT_EQ(hash(a.state), hash(fast));
}

TEST(EnergyAccount, ChangesNothingOnABaseThatDeforms) {
    Accounted a = heap_on_nodes();
    Shaking shaking;
    a.response = &shaking;
    State fast = a.state;
    a.pass(3000);
    advance(fast, a.base, a.physics, 3000, {2, fast_cycle()}, &shaking);
    EXPECT_EQ(hash(a.state), hash(fast));
}

TEST(EnergyAccount, DoesNotDependOnHowCallsAreCut) {
    Accounted whole = heap(), parts = heap();
    whole.pass(3000);
    for (int cycles : {1, 299, 700, 2000})
        parts.pass(cycles);
    EXPECT_EQ(whole.flows.boundary_work, parts.flows.boundary_work);
    EXPECT_EQ(whole.flows.friction, parts.flows.friction);
    EXPECT_EQ(whole.flows.damping, parts.flows.damping);
    EXPECT_EQ(whole.flows.bond_breaking, parts.flows.bond_breaking);
}

} // namespace
} // namespace listric::energy_account_test
