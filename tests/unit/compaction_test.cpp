// Phi = Phi_ini exp(-c depth); grains are kept, so r^2 (1 - Phi) and the mass never change. One
// square root and a few products are rounded: 1e-14 relative per application.

#include "dem/events/compaction.hpp"
#include "dem/events/property_update.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

namespace listric {

using namespace dem;
namespace {

using namespace support;

constexpr double surface_porosity = 0.5, c = 4e-4;

struct Burial {
    State state = make_state({{0.0, -3000.0, 90.0},
                              {500.0, -1500.0, 90.0},
                              {1000.0, -3000.0, 90.0},
                              {1500.0, 200.0, 90.0}});
    Compaction event{{}, surface_porosity, 0.0, 0.01};

    Burial() {
        const DiscColumns d = disc_columns(state);
        for (std::size_t i : {0, 1, 3}) {
            d.material[i] = sediment;
            d.stratum[i] = 1;
        }
        event.begin(state);
    }
    bool apply() { return event.apply(state, {}); }
    double porosity(std::size_t i) { return state.discs.get<double>("porosity")[i]; }
    double radius(std::size_t i) { return disc_columns(state).radius[i]; }
};

double expected_radius(double depth) {
    return 90.0 *
           std::sqrt((1.0 - surface_porosity) / (1.0 - surface_porosity * std::exp(-c * depth)));
}

TEST(Compaction, FollowsThePorosityLaw) {
    Burial b;
    EXPECT_FALSE(b.apply()); // no search: smaller discs touch nothing new
    EXPECT_NEAR(b.porosity(0), 0.5 * std::exp(-1.2), 1e-15);
    EXPECT_NEAR(b.porosity(1), 0.5 * std::exp(-0.6), 1e-15);
    EXPECT_NEAR(b.radius(0), expected_radius(3000.0), 1e-12);
    EXPECT_NEAR(b.radius(1), expected_radius(1500.0), 1e-12);
}

TEST(Compaction, KeepsMassBasementAndWhatIsAboveTheSurface) {
    Burial b;
    const std::vector<double> mass(disc_columns(b.state).mass.begin(),
                                   disc_columns(b.state).mass.end());
    b.apply();
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
        b.apply();
    }
    EXPECT_NEAR(b.radius(0), expected_radius(3000.0), 1e-11);
}

TEST(Compaction, UpliftRestoresNothing) {
    Burial b;
    b.apply();
    disc_columns(b.state).y[0] = -100.0;
    disc_columns(b.state).y[1] = -100.0;
    EXPECT_FALSE(b.apply());
    EXPECT_NEAR(b.radius(0), expected_radius(3000.0), 1e-12);
    disc_columns(b.state).y[0] = -3000.0;
    EXPECT_FALSE(b.apply()); // not even once it is back
}

TEST(Compaction, WeakenedDiscsShrinkWithTheirRock) {
    Burial b;
    add_weakened_columns(b.state);
    const WeakenedColumns w = weakened_columns(b.state);
    disc_columns(b.state).radius[0] = 117.0; // enlarged by 1.3
    w.rock_radius[0] = 90.0;
    w.rock_area[0] = 30000.0;
    b.apply();
    EXPECT_NEAR(w.rock_radius[0], expected_radius(3000.0), 1e-12);
    EXPECT_NEAR(b.radius(0) / w.rock_radius[0], 1.3, 1e-14);
    EXPECT_NEAR(w.rock_area[0], 30000.0 * std::pow(expected_radius(3000.0) / 90.0, 2), 1e-9);
    EXPECT_EQ(w.rock_radius[1], 0.0); // not weakened
}

} // namespace
} // namespace listric
