// Age over travel, with pauses that go by steps, and what is applied by years in them.

#include "dem/calendar.hpp"
#include "dem/event.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace listric::calendar_test {

using namespace dem;
namespace {

constexpr double rate = 0.01; // m/a

/// 1,030 m of extension, 60 steps of 1 Ma in 100 m each, 500 m, 3 steps of 20 Ma in 250 m each.
Calendar two_pauses() {
    return {rate,
            {{Travel(1030.0), Travel(100.0), 60, 1e6}, {Travel(7530.0), Travel(250.0), 3, 20e6}}};
}

TEST(Calendar, IsTravelOverTheRateWhereNoPauseGoesBySteps) {
    const Calendar plain(0.003);
    for (const double travel : {0.0, 0.1, 123.456, 1e4 / 3.0}) {
        EXPECT_EQ(plain.age(Travel(travel)), travel / 0.003);
        EXPECT_EQ(plain.years(Travel(0.7), Travel(travel)), (travel - 0.7) / 0.003);
    }
    EXPECT_EQ(plain.metres_per_year(Travel(5.0)), 0.003);
    const Schedule schedule(2500.0, plain);
    for (const std::int64_t n : {1, 2, 77}) {
        EXPECT_EQ(schedule.due(n).m, static_cast<double>(n) * 7.5);
        EXPECT_EQ(schedule.years(n), 2500.0);
        EXPECT_EQ(schedule.gap(n).m, schedule.spacing());
        EXPECT_EQ(schedule.nearest(schedule.due(n)), n);
        EXPECT_EQ(schedule.strain(1e-15, n), schedule.strain(1e-15));
    }
}

TEST(Calendar, IsStraightInAPauseAndGoesOnBehindIt) {
    const Calendar calendar = two_pauses();
    EXPECT_DOUBLE_EQ(calendar.age(Travel(1030.0)), 103e3);
    EXPECT_DOUBLE_EQ(calendar.age(Travel(1080.0)), 603e3);
    EXPECT_DOUBLE_EQ(calendar.age(Travel(7030.0)), 60.103e6);
    EXPECT_DOUBLE_EQ(calendar.age(Travel(7530.0)), 60.153e6);
    EXPECT_DOUBLE_EQ(calendar.age(Travel(8280.0)), 120.153e6);
    EXPECT_DOUBLE_EQ(calendar.age(Travel(9280.0)), 120.253e6);
    for (double travel = 0.0; travel < 9500.0; travel += 37.0)
        EXPECT_NEAR(calendar.travel(calendar.age(Travel(travel))).m, travel, 1e-6);
    EXPECT_DOUBLE_EQ(calendar.metres_per_year(Travel(1031.0)), 1e-4);
    EXPECT_DOUBLE_EQ(calendar.metres_per_year(Travel(7200.0)), rate);
    EXPECT_DOUBLE_EQ(calendar.way_back(Travel(7130.0), 10e3 + 1.5e6).m, 250.0);
    // A base that moves by years is fastest where years pass fastest.
    EXPECT_DOUBLE_EQ(calendar.years_per_metre(0.0, 50e3), 100.0);
    EXPECT_DOUBLE_EQ(calendar.years_per_metre(0.0, 60e6), 1e4);
    EXPECT_DOUBLE_EQ(calendar.years_per_metre(60.11e6, 120e6), 8e4);
}

TEST(Calendar, WhatIsAppliedInStepsStandsForAllYearsOnce) {
    for (const InSteps in_steps : {InSteps::as_travel_asks, InSteps::once})
        for (const double interval : {2.5e3, 10e3, 33e3, 50e3, 1e6}) {
            const Schedule schedule(interval, two_pauses(), in_steps);
            double years = 0.0;
            std::int64_t n = 0;
            for (Travel before; schedule.due(n + 1) <= Travel(9280.0); before = schedule.due(n)) {
                ++n;
                EXPECT_GT(schedule.due(n), before);
                EXPECT_DOUBLE_EQ(schedule.gap(n).m, (schedule.due(n) - before).m);
                EXPECT_EQ(schedule.nearest(schedule.due(n) - Travel(0.01)), n);
                EXPECT_EQ(schedule.nearest(schedule.due(n) + Travel(0.01)), n);
                years += schedule.years(n);
            }
            EXPECT_NEAR(years, two_pauses().age(schedule.due(n)), 1.0) << interval;
        }
}

TEST(Calendar, AStepIsAppliedOnceOrInHalves) {
    const Calendar calendar = two_pauses();
    const Schedule strata(20e3, calendar, InSteps::once); // 200 m
    EXPECT_EQ(strata.due(5).m, 1000.0);
    EXPECT_EQ(strata.due(6).m, 1130.0); // and the years of the 30 m before the pause
    EXPECT_DOUBLE_EQ(strata.years(6), 1e6 + 3e3);
    EXPECT_EQ(strata.due(7).m, 1230.0);
    EXPECT_EQ(strata.due(65).m, 7030.0); // the 60th step
    EXPECT_EQ(strata.due(66).m, 7230.0);
    EXPECT_DOUBLE_EQ(strata.years(66), 20e3);
    // 25 m are a quarter of 100 m; 40 m as well, and an eighth of 250 m is the next below both.
    for (const double metres : {25.0, 40.0}) {
        const Schedule often(metres / rate, calendar);
        const std::int64_t first = often.nearest(Travel(1055.0));
        EXPECT_EQ(often.due(first).m, 1055.0);
        EXPECT_DOUBLE_EQ(often.years(first + 1), 250e3);
        EXPECT_EQ(often.gap(often.nearest(Travel(7780.0))).m, metres == 25.0 ? 15.625 : 31.25);
    }
}

TEST(Calendar, OfTwoThatFollowDiscsTheRarerCoincidesWithTheOther) {
    const Schedule pores(2.5e3, two_pauses()), water(7.5e3, two_pauses());
    for (Travel at(1031.0); at < Travel(7030.0);) {
        const std::int64_t n = water.nearest(at);
        EXPECT_EQ(pores.due(pores.nearest(water.due(n))).m, water.due(n).m);
        at = water.due(n + 1);
    }
}

TEST(Calendar, APauseMayComeFirstAndBeOneStep) {
    const Calendar calendar(rate, {{Travel(0.0), Travel(200.0), 1, 100e6}});
    const Schedule strata(5e3, calendar, InSteps::once);
    EXPECT_EQ(strata.due(1).m, 200.0);
    EXPECT_DOUBLE_EQ(strata.years(1), 100e6);
    EXPECT_EQ(strata.due(2).m, 250.0);
    EXPECT_DOUBLE_EQ(strata.years(2), 5e3);
    EXPECT_EQ(strata.nearest(Travel(0.0)), 0);
}

} // namespace
} // namespace listric::calendar_test
