// Laws of mud: inverse and derivative by difference quotients, whose error is that of their step.

#include "fluid/pore_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace listric::pore_law_test {

using namespace fluid;
namespace {

constexpr PoreLaw law{};

TEST(PoreLaw, GrainsAboveADepthAreTheIntegralOfSolid) {
    double sum = 0.0;
    constexpr double step = 1.0; // m; the midpoint rule is good to 1e-8 here
    for (double z = 0.5 * step; z < 3000.0; z += step)
        sum += step * (1.0 - porosity_at(law, z));
    EXPECT_NEAR(grains_at(law, 3000.0), sum, 1e-6 * sum);
}

TEST(PoreLaw, EquivalentDepthInvertsIt) {
    for (const double depth : {0.0, 1e-3, 10.0, 500.0, 4000.0, 20000.0})
        EXPECT_NEAR(equivalent_depth(law, grains_at(law, depth)), depth, 1e-9 * depth + 1e-12);
    EXPECT_EQ(equivalent_depth(law, -5.0), 0.0);
}

TEST(PoreLaw, SlopeOfTheVoidRatio) {
    constexpr double grains = 2000.0, u = 8e6, step = 10.0;
    for (const double burial : {0.0, 5000.0}) { // first loading, and after it
        const double quotient = (void_ratio(law, grains, burial, u + step).value -
                                 void_ratio(law, grains, burial, u - step).value) /
                                (2.0 * step);
        EXPECT_NEAR(void_ratio(law, grains, burial, u).slope, quotient, 1e-6 * quotient);
    }
}

TEST(PoreLaw, ReboundJoinsFirstLoading) {
    constexpr double grains = 2000.0, u = 8e6;
    const double burial = burial_under(law, grains, u);
    EXPECT_NEAR(void_ratio(law, grains, burial, u).value, void_ratio(law, grains, 0.0, u).value,
                1e-12);
    const VoidRatio loaded = void_ratio(law, grains, 0.0, u + 1e5);
    const VoidRatio unloaded = void_ratio(law, grains, burial, u + 1e5);
    const double before = void_ratio(law, grains, 0.0, u).value;
    EXPECT_NEAR(unloaded.value - before, law.rebound * (loaded.value - before), 1e-12);
}

TEST(PoreLaw, WaterThatCarriesAllKeepsPoresAsTheyWereLaidDown) {
    EXPECT_NEAR(void_ratio(law, 1000.0, 0.0, 1000.0 * law.grain_weight).value, 1.0, 1e-12);
}

TEST(PoreLaw, PermeabilityOfEachLaw) {
    EXPECT_NEAR(permeability({}, 0.2), 1e-18, 1e-30);
    // 0.5^3 / 0.5^2 over 0.2^3 / 0.8^2
    EXPECT_NEAR(permeability({}, 0.5), 40e-18, 1e-29);
    EXPECT_EQ(permeability({}, 1e-5), permeability({}, 0.005));
    EXPECT_EQ(permeability({PermeabilityLaw::constant, 3e-19}, 0.4), 3e-19);
    // Clay fraction 0.4, void ratio 0.25: ln k = -52.433 - 0.411 + 7.950, by hand.
    EXPECT_NEAR(std::log(permeability({PermeabilityLaw::mudstone, 0.0, 0.4}, 0.2)), -44.90, 0.01);
}

} // namespace
} // namespace listric::pore_law_test
