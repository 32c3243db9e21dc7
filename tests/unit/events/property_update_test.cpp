// Weakened discs approach r_rock * (1 + q / (1 + 0.42 q)), q = mean stress over contact stiffness,
// by at most five percent per update; mass never changes. Where the volume around a disc grew, the
// correction takes it back, and what all have won or lost together, a common one. Tolerances are
// round-off of a few products.

#include "dem/contacts/soft_discs.hpp"
#include "dem/events/property_update.hpp"
#include "tests/support.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gtest/gtest.h>

namespace listric::property_update_test {

using namespace dem;
namespace {

using namespace support;

constexpr double r = 93.1;
constexpr std::size_t middle = 60; ///< of 11 x 11 discs

/// As heavy as under 10 km of rock, m/s^2: a few rows of discs are above the middle.
constexpr double heavy = 120.0;

/// A hexagonal lattice with the given disc weakened.
struct Lattice {
    State state;
    PropertyUpdate event{{}, 0.01, heavy};

    explicit Lattice(double rock_area = 0.0) {
        std::vector<Disc> discs = hexagonal(11, 11, r);
        state = make_state(discs);
        add_enlarged_columns(state);
        disc_columns(state).material[middle] = weak;
        enlarged_columns(state).rock_radius[middle] = r;
        enlarged_columns(state).rock_area[middle] = rock_area;
    }
    double radius() { return disc_columns(state).radius[middle]; }
    bool apply() { return event.apply(state, {}); }
    double stress() const {
        return 0.75 * overburden(state, std::vector{static_cast<std::int32_t>(middle)}, heavy)[0];
    }
};

const double cell = 2.0 * std::sqrt(3.0) * r * r;

TEST(PropertyUpdate, Enlargement) {
    const Material soft{8.5e8, 3.19e8, 0.0, false};
    EXPECT_DOUBLE_EQ(enlargement(4.25e8, soft), 1.0 + 1.0 / 1.42);
    EXPECT_DOUBLE_EQ(enlargement(0.0, soft), 1.0);
    EXPECT_DOUBLE_EQ(enlargement(-1e8, soft), 1.0);
}

TEST(PropertyUpdate, RadiusChangesByAtMostFivePercentAtATime) {
    Lattice l;
    const double target = r * enlargement(l.stress(), l.state.materials[weak]);
    ASSERT_GT(target, 1.3 * r);
    double expected = r;
    for (int k = 0; k < 10; ++k) {
        expected = std::min(1.05 * expected, target);
        EXPECT_TRUE(l.apply());
        EXPECT_NEAR(l.radius(), expected, 1e-12 * r);
    }
    EXPECT_NEAR(l.radius(), target, 1e-12 * r);
}

TEST(PropertyUpdate, UnloadedDiscsShrinkBack) {
    Lattice l;
    const DiscColumns d = disc_columns(l.state);
    std::ranges::fill(d.mass, 0.0); // nothing weighs on it
    d.radius[middle] = 1.3 * r;
    l.apply();
    EXPECT_NEAR(l.radius(), 0.95 * 1.3 * r, 1e-12 * r);
    for (int k = 0; k < 10; ++k)
        l.apply();
    EXPECT_NEAR(l.radius(), r, 1e-12 * r);
}

TEST(PropertyUpdate, MassAndSoundDiscsAreUntouched) {
    Lattice l(0.9 * cell);
    const State before = l.state;
    for (int k = 0; k < 5; ++k)
        l.apply();
    const ConstDiscColumns was = disc_columns(before);
    const DiscColumns now = disc_columns(l.state);
    for (std::size_t i = 0; i < now.x.size(); ++i) {
        EXPECT_EQ(now.mass[i], was.mass[i]);
        EXPECT_EQ(now.x[i], was.x[i]);
        if (i != middle) {
            EXPECT_EQ(now.radius[i], was.radius[i]);
        }
    }
    EXPECT_EQ(enlarged_columns(l.state).rock_radius[middle], r);
}

TEST(PropertyUpdate, LostAndWonVolumeIsTakenBack) {
    Lattice grown(0.99 * cell), shrunk(1.01 * cell), same(cell);
    for (Lattice* l : {&grown, &shrunk, &same})
        l->apply();
    const double factor = enlargement(same.stress(), same.state.materials[weak]);
    // dA / A = 2 factor dr / r, of which 0.3 is corrected at a time for the disc's zone and 0.5 for
    // all zones together; here the disc is both.
    EXPECT_NEAR(enlarged_columns(grown.state).correction[middle],
                1.0 - 0.8 * (1.0 / 0.99 - 1.0) / (2.0 * factor), 1e-12);
    EXPECT_NEAR(enlarged_columns(shrunk.state).correction[middle],
                1.0 - 0.8 * (1.0 / 1.01 - 1.0) / (2.0 * factor), 1e-12);
    EXPECT_NEAR(enlarged_columns(same.state).correction[middle], 1.0, 1e-12);
}

TEST(PropertyUpdate, WhatAllHaveLostIsTakenBackByAll) {
    constexpr std::size_t far = 24; // of another zone, with its volume as it was
    Lattice l(0.98 * cell);
    disc_columns(l.state).material[far] = weak;
    enlarged_columns(l.state).rock_radius[far] = r;
    enlarged_columns(l.state).rock_area[far] = cell;
    const double factor = enlargement(
        0.75 * overburden(l.state, std::vector{static_cast<std::int32_t>(far)}, heavy)[0],
        l.state.materials[weak]);
    l.apply();
    EXPECT_NEAR(enlarged_columns(l.state).correction[far],
                1.0 - 0.5 * (2.0 / 1.98 - 1.0) / (2.0 * factor), 1e-12);
}

TEST(PropertyUpdate, InAPauseRadiiFollowTheLoadAlone) {
    Lattice l(0.9 * cell); // it has won volume
    RigidBase base;
    base.motion = {.speed = 1.0, .stages = {{.end = Travel(100.0), .slope = 0.0, .speed = 1.0}}};
    const double target = r * enlargement(l.stress(), l.state.materials[weak]);
    for (int k = 0; k < 10; ++k)
        EXPECT_TRUE(l.event.apply(l.state, base));
    EXPECT_EQ(enlarged_columns(l.state).correction[middle], 1.0);
    EXPECT_NEAR(l.radius(), target, 1e-12 * r);
    l.apply();
    EXPECT_LT(enlarged_columns(l.state).correction[middle], 1.0);
}

TEST(PropertyUpdate, VolumeChangeIsThatOfThePowerCells) {
    Lattice l(0.9 * cell);
    EXPECT_NEAR(weakened_volume_change(l.state, {}), 0.1 * cell, 1e-12 * cell);
    disc_columns(l.state).radius[middle] *= 1.2; // enlargement is no volume
    EXPECT_NEAR(weakened_volume_change(l.state, {}), 0.1 * cell, 1e-12 * cell);
}

TEST(PropertyUpdate, NothingToDoWithoutWeakDiscs) {
    Lattice l;
    disc_columns(l.state).material[middle] = basement;
    const std::uint64_t before = hash(l.state);
    EXPECT_FALSE(l.apply());
    EXPECT_EQ(hash(l.state), before);
}

// A column of rock of a settled packing, then with its upper half replaced by sediment of half the
// mass. In a column that fades out over five mean radii are some two hundred discs at that depth,
// and what is in it varies by a few of them.
TEST(Overburden, IsTheWeightOfRockAndSedimentAbove) {
    const GenesisRequest request = packing_request(8e3, 6e3, 93.1);
    State state = settled(request);
    const DiscColumns d = disc_columns(state);
    std::vector<std::int32_t> rows;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.y[i] < -3.5e3)
            rows.push_back(static_cast<std::int32_t>(i));
    const auto expect = [&](auto stress_at) {
        const std::vector<double> weight = overburden(state, rows, 9.81);
        double sum = 0.0, squares = 0.0;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const double ratio = weight[k] / stress_at(d.y[static_cast<std::size_t>(rows[k])]);
            sum += ratio;
            squares += (ratio - 1.0) * (ratio - 1.0);
        }
        const auto count = static_cast<double>(rows.size());
        EXPECT_NEAR(sum / count, 1.0, 0.01);
        EXPECT_LT(std::sqrt(squares / count), 0.025);
    };
    expect([](double y) { return 2600.0 * 9.81 * -y; });
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.y[i] > -3e3)
            d.mass[i] *= 0.5;
    expect([](double y) { return 2600.0 * 9.81 * (-y - 1.5e3); });
}

} // namespace
} // namespace listric::property_update_test
