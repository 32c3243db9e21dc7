// A column of mud on a floor that sinks, with the laws and the solver of the pore fluid. The table
// is an earlier program's, which was written without this one and deposits after it solves: they
// differ by up to 0.011 in the overpressure ratio and by 0.007 in porosity at 1 km, where a step's
// layer counts most, and by less below. What no convention changes is held to the table's digits.

#include "coupling/pore_column.hpp"
#include "dem/units.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace listric::pore_column_test {

using namespace coupling;
namespace {

constexpr double year = 31557600.0, million = 1e6 * year;

MudColumn mud(double permeability) {
    MudColumn column;
    column.law.grain_weight = (2600.0 - 1030.0) * dem::standard_gravity;
    column.mud.at_fifth = permeability;
    return column;
}

SunkColumn sunk(double permeability, double distance, std::size_t steps) {
    return sink(mud(permeability), steady_floor(distance, steps),
                million / static_cast<double>(steps));
}

struct Row {
    double permeability, distance;
    std::vector<double> depths, ratios, porosities;
    double base_ratio, base_pressure, expelled, grains; ///< MPa, km
};

TEST(PoreColumn, TableOfSinkingFloors) {
    const std::vector<double> deep{1e3, 2e3, 4e3, 6e3}, shallow{1e3, 2e3};
    const std::vector<Row> table{
        {1e-16, 9e3, deep, {.01, .01, .03, .07}, {.334, .225, .105, .052}, .13, 15, .84, 7.71},
        {1e-17, 9e3, deep, {.06, .09, .18, .28}, {.336, .235, .129, .083}, .32, 37, .81, 7.50},
        {1e-18, 9e3, deep, {.36, .43, .53, .58}, {.382, .312, .230, .176}, .54, 57, .69, 6.81},
        {1e-19, 9e3, deep, {.90, .90, .90, .88}, {.480, .461, .425, .375}, .75, 62, .33, 5.40},
        {1e-20, 9e3, deep, {.90, .90, .90, .90}, {.479, .460, .425, .392}, .89, 71, .27, 5.19},
        {1e-18, 3e3, shallow, {.12, .14}, {.344, .245}, .12, 4, .56, 2.04},
        {1e-19, 3e3, shallow, {.53, .50}, {.412, .335}, .42, 12, .40, 1.86},
        {1e-20, 3e3, shallow, {.90, .89}, {.479, .457}, .74, 18, .14, 1.59}};
    for (const Row& row : table) {
        const SunkColumn column = sunk(row.permeability, row.distance, 400);
        ASSERT_TRUE(column.converged);
        for (std::size_t k = 0; k < row.depths.size(); ++k) {
            const MudLayer there = column.at(row.depths[k]);
            EXPECT_NEAR(there.overpressure_ratio, row.ratios[k], 0.0111)
                << row.permeability << ", " << row.depths[k];
            EXPECT_NEAR(there.porosity, row.porosities[k], 0.0075)
                << row.permeability << ", " << row.depths[k];
        }
        const MudLayer base = column.layers.front();
        EXPECT_NEAR(base.overpressure_ratio, row.base_ratio, 0.01) << row.permeability;
        EXPECT_NEAR(base.excess_pressure / 1e6, row.base_pressure, 0.6) << row.permeability;
        EXPECT_NEAR((column.came - column.left) / column.came, row.expelled, 0.011)
            << row.permeability;
        EXPECT_NEAR(column.grains / 1e3, row.grains, 0.04) << row.permeability;
        EXPECT_NEAR(column.came, column.surface + column.vented + column.left, 1e-13 * column.came);
    }
}

TEST(PoreColumn, WaterAtRestCompactsByTheLaw) {
    // Drained mud has the porosity of its depth, to what the last layer's settlement is of depth.
    const SunkColumn column = sunk(1e-13, 9e3, 400);
    for (const double depth : {1e3, 2e3, 4e3, 6e3})
        EXPECT_NEAR(column.at(depth).porosity, porosity_at(mud(1e-13).law, depth), 5e-4) << depth;
    for (const MudLayer& layer : column.layers)
        EXPECT_LT(layer.overpressure_ratio, 1e-3);
}

TEST(PoreColumn, LessWaterLeavesTheLessPermeableMudIs) {
    double before = 1.0;
    for (const double permeability : {1e-15, 1e-17, 1e-19, 1e-22}) {
        const SunkColumn column = sunk(permeability, 3e3, 200);
        const double through = column.surface / column.came;
        EXPECT_LT(through, before);
        before = through;
    }
    EXPECT_LT(before, 2e-3); // the first metres; else what leaves is vented
}

TEST(PoreColumn, ShorterStepsChangeLittle) {
    // Pressure at the base every 2,500 and every 1,250 a; the error is of first order.
    const double coarse = sunk(1e-18, 9e3, 400).layers.front().excess_pressure;
    const double fine = sunk(1e-18, 9e3, 800).layers.front().excess_pressure;
    EXPECT_NEAR(coarse, fine, 0.0025 * fine);
}

TEST(PoreColumn, GibsonNumberGrowsWithRateAndFallsWithPermeability) {
    const double rate = 9e3 / million;
    const double number = gibson_number(mud(1e-18), rate, million);
    EXPECT_NEAR(gibson_number(mud(1e-19), rate, million), 10.0 * number, 1e-9 * number);
    EXPECT_NEAR(gibson_number(mud(1e-18), 2.0 * rate, million), 4.0 * number, 1e-9 * number);
}

} // namespace
} // namespace listric::pore_column_test
