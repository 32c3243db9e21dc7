// EASY%Ro against a table that an independent program with steps of 0.1 K computed from the
// published constants. Tolerance 1e-3: Simpson's rule over at most 10 K is within 2e-4, digits are
// four.

#include "dem/numbers/units.hpp"
#include "thermal/maturity.hpp"

#include <gtest/gtest.h>

#include <array>

namespace listric::maturity_test {

using namespace thermal;
namespace {

constexpr double million_years = 1e6 * dem::seconds_per_year, tolerance = 1e-3;

TEST(Maturity, HeatingAtConstantRates) {
    struct Row {
        double rate; ///< K/Ma
        std::array<double, 8> reflectance;
    };
    constexpr std::array<Row, 4> table{
        Row{0.1, {0.4224, 0.5425, 0.6936, 0.8650, 1.1801, 1.5876, 2.1241, 2.7087}},
        Row{1, {0.3639, 0.4647, 0.6085, 0.7410, 0.9401, 1.2796, 1.7068, 2.2297}},
        Row{10, {0.3232, 0.4036, 0.5093, 0.6463, 0.7804, 1.0204, 1.3617, 1.7862}},
        Row{100, {0.2912, 0.3485, 0.4309, 0.5422, 0.6762, 0.8199, 1.0802, 1.4135}}};
    for (const Row& row : table) {
        Maturity maturity{};
        double now = 20.0, next = 60.0;
        for (const double expected : row.reflectance) {
            for (; now < next - 1e-9; now += 5.0)
                mature(maturity, now, now + 5.0, 5.0 / row.rate * million_years);
            EXPECT_NEAR(vitrinite_reflectance(maturity), expected, tolerance)
                << row.rate << " K/Ma to " << next;
            next += 20.0;
        }
    }
}

TEST(Maturity, HeldTemperatures) {
    struct Row {
        double temperature;
        std::array<double, 3> reflectance; ///< after 1, 10, 100 Ma
    };
    constexpr std::array<Row, 4> table{
        Row{100, {0.5264, 0.6305, 0.7193}}, Row{120, {0.6633, 0.7613, 0.9014}},
        Row{150, {0.9107, 1.1561, 1.4351}}, Row{180, {1.4071, 1.7680, 2.1985}}};
    for (const Row& row : table) {
        double time = 1.0;
        for (const double expected : row.reflectance) {
            Maturity maturity{};
            mature(maturity, row.temperature, row.temperature, time * million_years);
            EXPECT_NEAR(vitrinite_reflectance(maturity), expected, tolerance) << row.temperature;
            time *= 10.0;
        }
    }
}

TEST(Maturity, BuriedHeldAndLifted) {
    Maturity maturity{};
    mature(maturity, 20.0, 140.0, 10 * million_years);
    EXPECT_NEAR(vitrinite_reflectance(maturity), 0.7711, tolerance);
    mature(maturity, 140.0, 140.0, 40 * million_years);
    EXPECT_NEAR(vitrinite_reflectance(maturity), 1.1420, tolerance);
    mature(maturity, 140.0, 60.0, 10 * million_years);
    EXPECT_NEAR(vitrinite_reflectance(maturity), 1.1437, tolerance);
}

TEST(Maturity, Limits) {
    EXPECT_NEAR(vitrinite_reflectance({}), 0.2019, 1e-4);
    Maturity maturity{};
    mature(maturity, 1000.0, 1000.0, million_years);
    EXPECT_NEAR(vitrinite_reflectance(maturity), 4.6880, 1e-4);
    mature(maturity, -300.0, -300.0, million_years); // no temperature: nothing
    EXPECT_NEAR(vitrinite_reflectance(maturity), 4.6880, 1e-4);
}

} // namespace
} // namespace listric::maturity_test
