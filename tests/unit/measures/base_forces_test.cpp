// What discs and base do to each other: two discs on a detachment of 45 degrees and its flat.

#include "apps/measures/base_forces.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/contacts.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace listric::base_forces_test {
namespace {

using namespace dem;
using namespace measures;
using namespace support;

constexpr double radius = 100.0, overlap = 1.0;

/// Discs of radius 100 m, pressed by 1 m into the ramp, the flat and the right wall.
struct ThreeDiscs {
    State state = empty_state();
    RigidBase base;

    ThreeDiscs() {
        base.surfaces = {{.name = "detachment",
                          .chain = {line({0.0, 0.0}, {3e3, -3e3}), line({3e3, -3e3}, {20e3, -3e3})},
                          .friction = 0.5,
                          .conveyor = 1.0},
                         {"backstop", {line({0.0, 1e5}, {0.0, 0.0})}},
                         {.name = "right wall",
                          .chain = {line({10e3, -1e5}, {10e3, 1e5})},
                          .translation = {1.0, 0.0}}};
        base.motion = {2.0, 0.0};
        state.materials = {Material{}};
        state.mean_radius = radius;
        state.skin = 25.0;
        state.clock.time_step = 0.01;
        state.clock.cycle = 100;
        add_discs(state, 3);
        const DiscColumns d = disc_columns(state);
        const double h = std::sqrt(0.5) * (radius - overlap);
        const Point at[] = {{1.5e3 + h, -1.5e3 + h},
                            {6e3, -3e3 + radius - overlap},
                            {10e3 - radius + overlap, -1e3}};
        for (std::size_t i = 0; i < 3; ++i) {
            d.x[i] = at[i].x;
            d.y[i] = at[i].y;
            d.radius[i] = radius;
        }
        find_contacts(state, base);
    }

    /// Sets the shear force of the disc's contact over its normal force.
    void shear(std::int32_t disc, double ratio) {
        const BaseContactColumns b = base_contact_columns(state);
        for (std::size_t k = 0; k < b.disc.size(); ++k)
            if (b.disc[k] == disc)
                b.shear_force[k] = ratio * normal();
    }

    double normal() const { return contact_stiffness(state.materials[0]) * overlap; }
};

TEST(BaseForces, AreShearOverNormalForceByPart) {
    ThreeDiscs discs;
    discs.shear(0, 0.2);  // up the ramp: it holds
    discs.shear(1, -0.5); // to the right: it pulls
    const BaseForces forces = measure_base_forces(discs.state, discs.base);
    ASSERT_TRUE(forces.ramp && forces.flat);
    EXPECT_NEAR(forces.ramp->mobilised_friction, -0.2, 1e-6); // lengths of 1e4 m, an overlap of 1 m
    EXPECT_NEAR(forces.flat->mobilised_friction, 0.5, 1e-6);
    EXPECT_EQ(forces.ramp->sliding_share, 0.0);
    EXPECT_EQ(forces.flat->sliding_share, 1.0);
    EXPECT_NEAR(*forces.right_wall / discs.normal(), 1.0, 1e-6); // stiffnesses are floats
    EXPECT_FALSE(forces.left_wall);
}

TEST(BaseForces, SlipIsPastTheBaseThatRuns) {
    ThreeDiscs discs;
    const auto slips = [&] {
        const BaseForces forces = measure_base_forces(discs.state, discs.base);
        return Point{*forces.ramp->slip_ratio, *forces.flat->slip_ratio};
    };
    // The discs rest, the sheet leaves below them.
    EXPECT_NEAR(slips().x, -1.0, 1e-9);
    EXPECT_NEAR(slips().y, -1.0, 1e-9);
    discs.base.motion.runs_from = 3e3; // the ramp rests
    EXPECT_NEAR(slips().x, 0.0, 1e-9);
    EXPECT_NEAR(slips().y, -1.0, 1e-9);
    const DiscColumns d = disc_columns(discs.state); // down the ramp at the wall's speed
    d.vx[0] = 2.0 * std::sqrt(0.5);
    d.vy[0] = -d.vx[0];
    EXPECT_NEAR(slips().x, 1.0, 1e-9);
}

TEST(BaseForces, APartWithoutDiscsHasNone) {
    ThreeDiscs discs;
    disc_columns(discs.state).y[0] += 10.0 * radius;
    find_contacts(discs.state, discs.base);
    const BaseForces forces = measure_base_forces(discs.state, discs.base);
    EXPECT_FALSE(forces.ramp);
    EXPECT_TRUE(forces.flat);
}

} // namespace
} // namespace listric::base_forces_test
