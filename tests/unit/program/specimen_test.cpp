#include "apps/laboratory/sample.hpp"

#include "apps/laboratory/servo.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/monitor.hpp"
#include "tests/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace listric::specimen_test {

using namespace dem;
namespace {

using namespace support;

/// A disc on the floor of a box whose surfaces move by time.
Specimen disc_in_box() {
    Specimen s;
    s.state = make_state({{500.0, 100.0, 100.0}});
    s.state.clock.time_step = 0.01;
    s.base = box(2000.0, 2000.0);
    s.base.motion = {1.0, 0.0};
    find_contacts(s.state, s.base);
    return s;
}

TEST(Specimen, ASteeredSurfaceGoesOnFromWhereItIs) {
    Specimen s = disc_in_box();
    s.advance(100);
    s.steer(2, {-3.0, 2.0});
    EXPECT_NEAR(s.place_of(2).x, 2000.0, 1e-9);
    EXPECT_NEAR(s.place_of(2).y, -2000.0, 1e-9);
    s.advance(100);
    s.steer(2, {1.0, 0.0});
    s.advance(50);
    EXPECT_NEAR(s.place_of(2).x, 2000.0 - 3.0 + 0.5, 1e-9);
    EXPECT_NEAR(s.place_of(2).y, -2000.0 + 2.0, 1e-9);
}

TEST(Specimen, AReshapedSurfaceIsWhereItsChainIs) {
    Specimen s = disc_in_box();
    s.advance(100);
    s.reshape(0, {line({50.0, 2000.0}, {50.0, -2000.0})}, {4.0, 0.0});
    EXPECT_NEAR(s.place_of(0).x, 50.0, 1e-9);
    s.advance(100);
    EXPECT_NEAR(s.place_of(0).x, 54.0, 1e-9);
}

// The wall comes from afar with changing velocities. Were it searched only where its last velocity
// puts it, it would pass through the disc.
TEST(Specimen, ASteeredSurfaceMeetsTheDiscsInItsWay) {
    Specimen s = disc_in_box();
    for (int k = 0; k < 400; ++k) {
        s.steer(2, {k % 2 ? -9.0 : -1.0, 0.0});
        s.advance(60);
    }
    EXPECT_NEAR(s.place_of(2).x, 2000.0 - 1200.0, 1e-6);
    for (int k = 0; k < 100; ++k) {
        s.steer(2, {k % 2 ? -9.0 : -1.0, 0.0});
        s.advance(60);
    }
    EXPECT_GT(s.place_of(2).x, 499.0);
    EXPECT_LT(disc_columns(s.state).x[0], s.place_of(2).x - 99.0);
}

TEST(Monitor, SurfaceLoadsAreWhatDiscsFeel) {
    Specimen s = disc_in_box();
    disc_columns(s.state).y[0] = 99.0;
    const auto loads = surface_loads(s.state, s.base);
    EXPECT_NEAR(loads[1].force.y, contact_stiffness(Material{}), 1e-7 * 8.5e10); // single precision
    EXPECT_EQ(loads[1].contacts, 1);
    EXPECT_EQ(loads[0].contacts, 0);
}

// A wall on a spring that yields at a steady rate: the integral part removes the lag.
TEST(Servo, HoldsItsStressOnAYieldingSample) {
    Servo servo;
    constexpr double stiffness = 1e9, interval = 0.05, target = 1e6, yield = 0.01;
    double force = 0.0;
    for (int k = 0; k < 5000; ++k)
        force += stiffness * interval * (servo.speed(target - force, stiffness, interval) - yield);
    EXPECT_NEAR(force, target, 1e-3 * target);
    EXPECT_EQ(Servo{}.speed(1e30, stiffness, interval), Servo{}.fastest);
}

} // namespace
} // namespace listric::specimen_test
