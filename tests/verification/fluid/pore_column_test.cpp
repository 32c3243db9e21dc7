// A column of mud on a floor that sinks, with the laws and the solver of the pore fluid, against
// docs/record/2026-11/pore-fluid/column.py, which was written without it: SciPy's band solver, its
// own Newton's method, no line search. Both lay down a layer a step and then solve, so they are
// equal but for where Newton's methods end and for digits printed.

#include "dem/numbers/units.hpp"
#include "fluid/pore_column.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace listric::pore_column_test {

using namespace fluid;
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
    double base_pressure, grains; ///< MPa, km
};

TEST(PoreColumn, EqualsAnotherProgram) {
    const std::vector<double> deep{1e3, 2e3, 4e3, 6e3}, shallow{1e3, 2e3};
    const std::vector<Row> table{
        {1e-16,
         9e3,
         deep,
         {.0065, .0105, .0288, .0704},
         {.3360, .2265, .1053, .0528},
         15.17,
         7.719},
        {1e-17,
         9e3,
         deep,
         {.0572, .0860, .1755, .2759},
         {.3428, .2400, .1311, .0837},
         37.36,
         7.527},
        {1e-18,
         9e3,
         deep,
         {.3656, .4313, .5317, .5831},
         {.3876, .3157, .2318, .1779},
         57.07,
         6.834},
        {1e-19,
         9e3,
         deep,
         {.9000, .9000, .9000, .8819},
         {.4804, .4616, .4261, .3780},
         62.07,
         5.409},
        {1e-20,
         9e3,
         deep,
         {.9000, .9000, .9000, .9000},
         {.4804, .4616, .4261, .3933},
         71.04,
         5.218},
        {1e-18, 3e3, shallow, {.1174, .1360}, {.3511, .2500}, 3.90, 2.067},
        {1e-19, 3e3, shallow, {.5412, .5098}, {.4162, .3385}, 11.88, 1.867},
        {1e-20, 3e3, shallow, {.9000, .8954}, {.4804, .4599}, 18.36, 1.614}};
    for (const Row& row : table) {
        const SunkColumn column = sunk(row.permeability, row.distance, 400);
        ASSERT_TRUE(column.converged);
        for (std::size_t k = 0; k < row.depths.size(); ++k) {
            const MudLayer there = column.at(row.depths[k]);
            EXPECT_NEAR(there.overpressure_ratio, row.ratios[k], 2e-4)
                << row.permeability << ", " << row.depths[k];
            EXPECT_NEAR(there.porosity, row.porosities[k], 2e-4)
                << row.permeability << ", " << row.depths[k];
        }
        EXPECT_NEAR(column.layers.front().excess_pressure / 1e6, row.base_pressure, 0.02)
            << row.permeability;
        EXPECT_NEAR(column.grains / 1e3, row.grains, 0.001) << row.permeability;
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

TEST(PoreColumn, ConvergesWithShorterSteps) {
    // Layers are a step's, so grid and interval are refined together. First order: differences
    // halve. With 2,500 a pressure at the base is within 0.5 % of that with 500 a, and the ratio
    // at 1 km, where a layer counts most, within 0.006.
    const auto at = [](std::size_t steps) {
        const SunkColumn column = sunk(1e-18, 9e3, steps);
        return std::pair(column.layers.front().excess_pressure, column.at(1e3).overpressure_ratio);
    };
    const auto [base_100, ratio_100] = at(100);
    const auto [base_200, ratio_200] = at(200);
    const auto [base_400, ratio_400] = at(400);
    const auto [base_2000, ratio_2000] = at(2000);
    EXPECT_NEAR((ratio_200 - ratio_100) / (ratio_400 - ratio_200), 2.0, 0.25);
    EXPECT_NEAR((base_200 - base_100) / (base_400 - base_200), 2.0, 0.25);
    EXPECT_NEAR(base_400, base_2000, 0.005 * base_2000);
    EXPECT_NEAR(ratio_400, ratio_2000, 0.006);
}

TEST(PoreColumn, PorosityIsNoLessThanThatOfThePressureInASettledColumn) {
    // No column of a height has more grains than one whose water is at rest, so with a ratio of
    // overpressure porosity is at least the law's under what the pressure leaves of those. Layers
    // of finite thickness miss that by 1e-4.
    for (const double permeability : {1e-16, 1e-17, 1e-18, 1e-19})
        for (const MudLayer& layer : sunk(permeability, 9e3, 200).layers) {
            const PoreLaw law = mud(permeability).law;
            const double grains = (1.0 - layer.overpressure_ratio) * grains_at(law, layer.depth);
            EXPECT_GE(layer.porosity, porosity_at(law, equivalent_depth(law, grains)) - 1e-4);
        }
}

TEST(PoreColumn, GibsonNumberGrowsWithRateAndFallsWithPermeability) {
    const double rate = 9e3 / million;
    const double number = gibson_number(mud(1e-18), rate, million);
    EXPECT_NEAR(gibson_number(mud(1e-19), rate, million), 10.0 * number, 1e-9 * number);
    EXPECT_NEAR(gibson_number(mud(1e-18), 2.0 * rate, million), 4.0 * number, 1e-9 * number);
}

} // namespace
} // namespace listric::pore_column_test
