// Phi = Phi_ini exp(-c depth); grains are kept, so r^2 (1 - Phi) and the mass never change. A few
// square roots and products are rounded per application, some 1e-15 relative each; twenty of them
// stay below 1e-13.

#include "dem/contacts/soft_discs.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/events/compaction.hpp"
#include "dem/events/property_update.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

namespace listric::compaction_test {

using namespace dem;
namespace {

using namespace support;

constexpr double surface_porosity = 0.5, c = 4e-4;

/// Four discs that matter, below a surface of others at y = 0.
struct Burial {
    static std::vector<Disc> discs() {
        std::vector<Disc> all{{0.0, -3000.0, 90.0},
                              {500.0, -1500.0, 90.0},
                              {1000.0, -3000.0, 90.0},
                              {1500.0, 600.0, 90.0}};
        for (int k = -10; k < 20; ++k)
            all.push_back({180.0 * k, -90.0, 90.0});
        return all;
    }

    State state = make_state(discs());
    RigidBase base;
    Compaction event{{}, surface_porosity, 0.01};

    Burial() {
        base.motion.speed = 1.0;
        const DiscColumns d = disc_columns(state);
        for (std::size_t i : {0, 1, 3}) {
            d.material[i] = sediment;
            d.stratum[i] = 1;
        }
        event.begin(state);
    }
    void apply() {
        EXPECT_FALSE(event.apply(state, base)); // no search: smaller discs touch nothing new
    }
    /// To the next application.
    void pass() {
        for (std::size_t i = 0; i < state.discs.rows(); ++i)
            disc_columns(state).radius[i] += rate(i) * event.schedule().spacing();
        state.clock.travel.m = state.clock.extension.m += event.schedule().spacing();
    }
    void last(int intervals) {
        for (; intervals > 0; --intervals) {
            apply();
            pass();
        }
    }
    double porosity(std::size_t i) { return state.discs.get<double>("porosity")[i]; }
    double rate(std::size_t i) { return state.discs.get<double>("radius_rate")[i]; }
    double radius(std::size_t i) { return disc_columns(state).radius[i]; }
};

double expected_radius(double depth) {
    return 90.0 *
           std::sqrt((1.0 - surface_porosity) / (1.0 - surface_porosity * std::exp(-c * depth)));
}

TEST(Compaction, FollowsThePorosityLaw) {
    Burial b;
    b.last(200);
    EXPECT_NEAR(b.porosity(0), 0.5 * std::exp(-1.2), 1e-14);
    EXPECT_NEAR(b.porosity(1), 0.5 * std::exp(-0.6), 1e-14);
    EXPECT_NEAR(b.radius(0), expected_radius(3000.0), 1e-11);
    EXPECT_NEAR(b.radius(1), expected_radius(1500.0), 1e-11);
}

TEST(Compaction, ShrinksNoDiscAtOnce) {
    Burial b;
    b.apply();
    EXPECT_EQ(b.radius(0), 90.0);
    EXPECT_NEAR(b.rate(0), -Compaction::fastest * 90.0, 1e-12); // as fast as it may
    b.pass();
    // The shrinkage that is left has not been forgotten: grains are kept.
    EXPECT_NEAR(std::pow(b.radius(0), 2) * (1.0 - b.porosity(0)), 0.5 * 90.0 * 90.0, 1e-9);
    EXPECT_EQ(b.rate(2), 0.0);
}

/// A pile of discs, the uppermost first, whose heights go with their areas: it sinks as they
/// shrink.
struct Pile {
    State state;
    Compaction event{{}, surface_porosity, 0.01};

    Pile(std::vector<double> radii, const std::vector<double>& porosity) {
        std::vector<Disc> discs;
        for (const double radius : radii)
            discs.push_back({0.0, 0.0, radius});
        state = make_state(discs);
        std::ranges::fill(disc_columns(state).stratum, 1);
        event.begin(state);
        std::ranges::copy(porosity, state.discs.get<double>("porosity").end() -
                                        static_cast<std::ptrdiff_t>(porosity.size()));
        settle();
    }
    void settle() {
        const DiscColumns d = disc_columns(state);
        double y = 0.0; // of the floor
        for (std::size_t i = d.y.size(); i-- > 0;) {
            const double height = 0.04 * d.radius[i] * d.radius[i];
            d.y[i] = y + 0.5 * height;
            y += height;
        }
    }
    void compact(int intervals) {
        RigidBase base;
        base.motion.speed = 1.0;
        const DiscColumns d = disc_columns(state);
        for (; intervals > 0; --intervals) {
            event.apply(state, base);
            const auto rate = state.discs.get<double>("radius_rate");
            for (std::size_t i = 0; i < d.y.size(); ++i)
                d.radius[i] += rate[i] * event.schedule().spacing();
            settle();
        }
    }
};

TEST(Compaction, WhatIsLaidDownAtOnceCompactsAsIfSlowly) {
    // 5 km, and 1 km more at once. By their depth before what is above them has compacted, discs at
    // the bottom would lose a tenth too many of their pores.
    Pile before(std::vector<double>(50, 50.0), {});
    before.compact(200);
    const auto radius = disc_columns(before.state).radius;
    std::vector<double> radii(10, 50.0);
    radii.insert(radii.end(), radius.begin(), radius.end());
    const auto known = before.state.discs.get<double>("porosity");
    Pile buried(radii, {known.begin(), known.end()});
    buried.compact(200);
    const DiscColumns d = disc_columns(buried.state);
    const auto porosity = buried.state.discs.get<double>("porosity");
    for (std::size_t i = 0; i < d.y.size(); ++i) {
        const double expected = surface_porosity * std::exp(-c * (d.y[0] + d.radius[0] - d.y[i]));
        EXPECT_NEAR(porosity[i], expected, 0.02 * expected) << i;
    }
}

TEST(Compaction, InTheRampOfTheMotion) {
    Burial b;
    b.base.motion.ramp = 80.0; // 40 m; the first 25 m take 63.2 s
    b.apply();
    const double lost = 1.0 - std::pow(expected_radius(1500.0) / 90.0, 2); // of the area, at last
    EXPECT_NEAR(b.rate(1) * std::sqrt(2.0 * 25.0 * 80.0),
                std::max(std::sqrt(1.0 - Compaction::approach * lost) - 1.0,
                         -Compaction::fastest * std::sqrt(4000.0)) *
                    90.0,
                1e-11);
}

TEST(Compaction, KeepsMassBasementAndWhatIsAboveTheSurface) {
    Burial b;
    const std::vector<double> mass(disc_columns(b.state).mass.begin(),
                                   disc_columns(b.state).mass.end());
    b.last(5);
    for (std::size_t i = 0; i < mass.size(); ++i)
        EXPECT_EQ(disc_columns(b.state).mass[i], mass[i]);
    EXPECT_EQ(b.radius(2), 90.0);
    EXPECT_EQ(b.radius(3), 90.0);
    EXPECT_EQ(b.porosity(3), surface_porosity);
}

TEST(Compaction, BurialInStepsEqualsBurialAtOnce) {
    Burial b;
    for (double y : {-700.0, -1900.0, -3000.0}) {
        disc_columns(b.state).y[0] = y;
        b.last(200);
    }
    EXPECT_NEAR(b.radius(0), expected_radius(3000.0), 1e-11);
}

TEST(Compaction, UpliftRestoresNothing) {
    Burial b;
    b.last(200);
    disc_columns(b.state).y[0] = -300.0;
    disc_columns(b.state).y[1] = -300.0;
    b.last(1);
    EXPECT_NEAR(b.radius(0), expected_radius(3000.0), 1e-11);
    disc_columns(b.state).y[0] = -3000.0;
    b.last(1); // not even once it is back
    EXPECT_NEAR(b.radius(0), expected_radius(3000.0), 1e-11);
}

TEST(Compaction, WeakenedDiscsShrinkWithTheirRock) {
    Burial b;
    add_enlarged_columns(b.state);
    const EnlargedColumns w = enlarged_columns(b.state);
    disc_columns(b.state).radius[0] = 117.0; // enlarged by 1.3
    w.rock_radius[0] = 90.0;
    w.rock_area[0] = 30000.0;
    b.last(200);
    EXPECT_NEAR(w.rock_radius[0], expected_radius(3000.0), 1e-11);
    EXPECT_NEAR(b.radius(0) / w.rock_radius[0], 1.3, 1e-13);
    EXPECT_NEAR(w.rock_area[0], 30000.0 * std::pow(expected_radius(3000.0) / 90.0, 2), 1e-9);
    EXPECT_EQ(w.rock_radius[1], 0.0); // not weakened
}

TEST(Compaction, MomentOfInertiaIsThatOfTheRadiusAtItsLastApplication) {
    Burial b;
    b.last(1);
    const auto inertial = b.state.discs.get<double>("inertial_radius");
    EXPECT_EQ(inertial[0], 90.0);
    b.apply();
    EXPECT_EQ(inertial[0], b.radius(0));
    EXPECT_LT(inertial[0], 90.0);
}

} // namespace
} // namespace listric::compaction_test
