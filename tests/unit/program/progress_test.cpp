// The line of progress, and the time that a run has to go: replayed from clocks of real runs.

#include "apps/run/forecast/time_left.hpp"
#include "apps/run/progress_line.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"
#include "tests/places.hpp"
#include "tests/small_halfgraben.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <utility>
#include <vector>

namespace listric::progress_test {
namespace {

namespace fs = std::filesystem;

/// The clock of a run: its forecast, when how many cycles were done, when the last one, when all.
struct Trace {
    Forecast forecast;
    struct Reading {
        double done, all, clock;
    };
    std::vector<Reading> readings = {};
    double end = 0.0, over = 0.0;
    double bound = 1.25; ///< of time left over the true one; more where the machine slowed down
};

Trace read_trace(const fs::path& file) {
    Trace trace;
    std::istringstream lines(support::contents(file));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string first;
        words >> first;
        if (first == "forecast") {
            Forecast& f = trace.forecast;
            words >> f.before >> f.extension >> f.after >> f.growth;
        } else if (first == "windows") {
            Forecast& f = trace.forecast;
            words >> f.windows >> f.window_share >> f.ramp_share;
        } else if (first == "picture") {
            double begin;
            words >> trace.forecast.picture >> begin;
            trace.forecast.pictures = {begin};
        } else if (first == "end") {
            words >> trace.end;
        } else if (first == "over") {
            words >> trace.over;
        } else if (first == "bound") {
            words >> trace.bound;
        } else if (!first.starts_with('#')) {
            Trace::Reading reading{std::stod(first), 0.0, 0.0};
            words >> reading.all >> reading.clock;
            trace.readings.push_back(reading);
        }
    }
    return trace;
}

/// The worst of a run's moments, once a part of its time has gone.
struct Worst {
    double off = 0.0;     ///< time left over the true one, as a factor from 1
    double early = 0.0;   ///< before 5 % of the run: time left over the forecast
    double figures = 0.0; ///< how far off while figures are made, over all their time
};

Worst replay(const Trace& trace) {
    TimeLeft left(trace.forecast);
    Worst worst;
    // As shown: at the readings, and between them where they are far apart.
    const auto look = [&](double clock) {
        const double told = left.at(clock), true_left = trace.over - clock;
        if (clock < 0.05 * trace.over)
            worst.early = std::max(worst.early, told / trace.forecast.all());
        else if (clock < trace.end)
            worst.off = std::max(worst.off, std::max(told / true_left, true_left / told));
        else // at their end any number of seconds is many times the truth
            worst.figures =
                std::max(worst.figures, std::abs(told - true_left) / (trace.over - trace.end));
    };
    look(0.0);
    double before = 0.0;
    const auto look_until = [&](double clock) {
        for (double at = before + 0.2; at < clock; at += 0.2)
            look(at);
        before = clock;
    };
    for (const auto& [done, all, clock] : trace.readings) {
        look_until(clock);
        left.read(done, all, clock);
        look(clock);
    }
    look_until(trace.end);
    left.end_extension(trace.end);
    look_until(trace.over);
    return worst;
}

TEST(Progress, TimeLeftIsRightOfRunsThatWere) {
    std::size_t traces = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(source_folder) / "tests/traces")) {
        const Trace trace = read_trace(entry.path());
        const Worst worst = replay(trace);
        EXPECT_LT(worst.off, trace.bound) << entry.path();
        EXPECT_LE(worst.early, 2.0) << entry.path();
        EXPECT_LT(worst.figures, trace.bound - 1.0) << entry.path();
        ++traces;
    }
    EXPECT_GE(traces, 3u);
}

/// A run of a thousand readings whose cycles take `pace` times what the forecast says.
Trace steady(double pace, double growth) {
    Trace trace{.forecast = {.before = 3.0, .extension = 100.0, .after = 5.0, .growth = growth}};
    const double before = 3.0 * pace;
    for (int k = 0; k <= 1000; ++k) {
        const double s = k / 1000.0;
        const double work = (s + 0.5 * (growth - 1.0) * s * s) / (1.0 + 0.5 * (growth - 1.0));
        trace.readings.push_back({1e3 * s, 1e3, before + 100.0 * pace * work});
    }
    trace.end = before + 100.0 * pace;
    trace.over = trace.end + 5.0 * pace;
    return trace;
}

TEST(Progress, TimeLeftFollowsTheMachine) {
    for (const double pace : {0.5, 1.0, 1.5})
        for (const double growth : {1.0, 2.0}) {
            const Worst worst = replay(steady(pace, growth));
            // A forecast that is off by two: at 5 % it still counts as a third of what was seen.
            EXPECT_LT(worst.off, pace == 1.0 ? 1.001 : 1.4) << pace << ", " << growth;
            EXPECT_LE(worst.early, 1.5);
        }
    // However slow the machine has become, the first minutes do not frighten.
    EXPECT_LE(replay(steady(30.0, 1.0)).early, 2.0);
}

TEST(Progress, ARunOfNoCyclesHasAShareToo) {
    constexpr double none = 0.0;
    TimeLeft left(
        {.before = 3.0, .after = 1.0, .window_share = 1.0 / none, .ramp_share = none / none});
    left.read(0.0, 0.0, 3.0);
    EXPECT_NEAR(left.share_done(3.0), 0.75, 1e-9);
    left.end_extension(3.0);
    EXPECT_NEAR(left.share_done(4.0), 1.0, 1e-9);
    EXPECT_NEAR(left.at(3.0), 1.0, 1e-9);
}

TEST(Progress, AResumedRunCountsItsOwnCycles) {
    TimeLeft left({.before = 3.0, .extension = 100.0, .after = 5.0});
    left.read(500.0, 1000.0, 0.0);
    EXPECT_NEAR(left.at(0.0), 55.0, 1e-9);
    for (int k = 1; k <= 100; ++k)
        left.read(500.0 + k, 1000.0, 0.2 * k); // twice as slow as foreseen
    // The forecast counts as 1.5 % of the run beside the 10 % that were seen.
    EXPECT_NEAR(left.at(20.0), 80.0 + 10.0, 9.0);
}

TEST(Progress, DurationsAreRightToFivePercent) {
    const std::pair<double, const char*> durations[] = {
        {3.6, "4 s"},      {89.4, "89 s"},        {89.6, "1 min 30 s"},
        {124.0, "2 min"},  {126.0, "2 min 10 s"}, {569.0, "9 min 30 s"},
        {571.0, "10 min"}, {5399.0, "90 min"},    {5401.0, "1.5 h"}};
    for (const auto& [seconds, text] : durations)
        EXPECT_EQ(rough_duration(seconds), text) << seconds;
}

TEST(Progress, LineFitsTheTerminal) {
    setenv("TZ", "UTC", 1);
    tzset();
    const Progress then{.share = 0.47, .what = "4.7 of 10 km", .left = 240.0, .now = 34020};
    EXPECT_EQ(progress_line(then, 80), "[####------] 47 %  4.7 of 10 km  4 min left (ends 09:31)");
    EXPECT_EQ(progress_line(then, 55), "[####------] 47 %  4.7 of 10 km  4 min left");
    EXPECT_EQ(progress_line(then, 39), "[##---] 47 %  4.7 of 10 km  4 min left");
    EXPECT_EQ(progress_line(then, 30), "47 %  4.7 of 10 km  4 min left");
    const Progress tomorrow{.share = 0.999, .what = "x", .left = 90000.0, .now = 34020};
    EXPECT_EQ(progress_line(tomorrow, 80), "[#########-] 99 %  x  25.0 h left (ends Fri 10:27)");
    unsetenv("TZ");
    tzset();
    for (const char* what : {"0.00 of 10.00 km", "hanging wall: second equilibrium (45 %)",
                             "sedimentation: 12345 discs laid down"})
        for (const std::size_t columns : {1u, 20u, 39u, 59u, 79u, 119u})
            EXPECT_LE(cut_to(progress_line({0.5, what, 4000.0, 0}, columns), columns).size(),
                      columns);
}

} // namespace
} // namespace listric::progress_test
