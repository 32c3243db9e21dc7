#include "apps/measures/strata/backstripping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace listric::backstripping_test {

using namespace measures;
namespace {

constexpr BackstrippingDensities densities{3300.0, 1030.0, 2600.0};

TEST(Backstripping, AKilometreOf2300) {
    EXPECT_NEAR(tectonic_subsidence({1000.0, 2300.0}, densities), 440.5, 0.05);
    // Water is its own subsidence; a sea that has risen has done some by itself.
    EXPECT_EQ(tectonic_subsidence({0.0, 1030.0}, densities, 200.0), 200.0);
    EXPECT_NEAR(tectonic_subsidence({1000.0, 2300.0}, densities, 200.0, 100.0),
                440.5 + 200.0 - 100.0 - 100.0 * 1030.0 / 2270.0, 0.05);
}

/// A column by Athy's law is found as it was; its lower stratum alone is thicker.
TEST(Backstripping, PoresOpenAsStrataAboveGo) {
    const dem::PorosityLaw pores{0.5, 4e-4};
    const auto pores_above = [&](double z) {
        return pores.surface_porosity / pores.coefficient *
               (1.0 - std::exp(-pores.coefficient * z));
    };
    const DrilledStratum deep{1000.0 - pores_above(3000.0) + pores_above(2000.0), pores},
        shallow{2000.0 - pores_above(2000.0), pores};
    const std::vector<DrilledStratum> both{deep, shallow};
    EXPECT_NEAR(decompacted(both, densities).thickness, 3000.0, 1e-6);
    const SedimentColumn alone = decompacted(std::vector{deep}, densities);
    EXPECT_NEAR(alone.thickness - pores_above(alone.thickness), deep.grains, 1e-6);
    EXPECT_GT(alone.thickness, 1200.0);
    EXPECT_NEAR(alone.density, 1030.0 + 1570.0 * deep.grains / alone.thickness, 1e-9);
    EXPECT_DOUBLE_EQ(
        decompacted(std::vector{DrilledStratum{600.0, {0.4, 0.0}}}, densities).thickness, 1000.0);
    EXPECT_EQ(decompacted({}, densities).thickness, 0.0);
}

} // namespace
} // namespace listric::backstripping_test
