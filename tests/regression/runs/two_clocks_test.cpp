// A run's moments told by other clocks: with a pause in which no disc moves, or with a stage of
// another rate, every measure that depends on extension is that of the run without, to the last
// bit.

#include "apps/archive/folder/run_history.hpp"
#include "apps/archive/folder/setting.hpp"
#include "apps/archive/tables/fault_fields.hpp"
#include "apps/measures/evolution.hpp"
#include "apps/measures/faults/fault_history.hpp"
#include "tests/scene_runs.hpp"

#include <fmt/format.h>

#include <functional>
#include <map>

namespace listric::two_clocks_test {

using namespace dem;
using namespace measures;
using namespace support;

namespace {

using Numbers = std::map<std::string, double>;

/// Moments of a run and how it was moved.
struct Told {
    std::vector<State> moments;
    Motion motion;
};

/// Measures of the last moment that look back at the others, and its faults' fields.
Numbers numbers_of(const Told& run, Setting setting, RigidBase base, const Measures& measures) {
    setting.motion = base.motion = run.motion;
    setting.youngest_sediment = {}; // by age, which goes on in a pause
    const State& now = run.moments.back();
    std::vector<Past> all, past;
    std::vector<Travel> times;
    std::vector<DiscPlaces> places;
    for (std::size_t k = 0; k + 1 < run.moments.size(); ++k) {
        all.push_back(remember(setting, base, run.moments[k], all));
        times.push_back(run.moments[k].clock.travel);
    }
    for (const std::size_t k : whole_windows(times, now.clock.travel, setting)) {
        past.push_back(all[k]);
        places.push_back(all[k].places);
    }
    const FaultReport faults = report_faults(setting, base, now, places);
    Numbers numbers;
    for (const auto& [name, value] :
         measure_evolution(setting, base, now, faults, measures, {}, past))
        numbers[name] = value;
    for (std::size_t k = 0; k < faults.faults.size(); ++k) {
        const Fault& f = faults.faults[k];
        const auto add = [&](const char* name, double value) {
            numbers[fmt::format("{} of fault {}", name, k)] = value;
        };
        add("born", f.born_at.m);
        add("traced", f.traced_since.m);
        add("foot at birth", f.foot_at_birth.x);
        for (const auto& [horizon, at] : f.cutoffs)
            add(fmt::format("throw of horizon {}", horizon).c_str(), at.height());
    }
    std::erase_if(numbers, [](const auto& one) {
        return one.first.ends_with("rate_mm_per_a") || one.first.ends_with("travel_m");
    });
    return numbers;
}

/// Moments with another clock: travel by extension.
std::vector<State> told_by(const std::vector<State>& moments,
                           const std::function<double(double)>& travel) {
    std::vector<State> told = moments;
    for (State& state : told) {
        state.clock.travel = Travel(travel(state.clock.extension.m));
        for (double& start : disc_columns(state).start_travel)
            start = travel(start);
    }
    return told;
}

void expect_equal(const Numbers& found, const Numbers& expected) {
    EXPECT_EQ(found.size(), expected.size());
    for (const auto& [name, value] : expected)
        EXPECT_TRUE(found.contains(name) && found.at(name) == value)
            << name << ": " << value << ", with the other clock "
            << (found.contains(name) ? found.at(name) : std::nan(""));
}

class TwoClocks : public SceneRuns {};

TEST_F(TwoClocks, WhatDependsOnExtensionIsThatOfTheRunWithout) {
    Scene scene = load_scene({.scene = "lis1",
                              .set = {"hanging_wall.mean_radius_m=400.0",
                                      "extension.distance_m=2500.0", "output.interval_m=250.0"}});
    run(scene, "plain");
    const RunFolder folder(options("plain").output);
    const Setting setting = make_setting(folder.scene, folder.parts);
    const RigidBase& base = folder.parts.base;
    Told plain{{}, base.motion};
    Measures measures;
    for (const auto& path : folder.snapshots) {
        Moment moment = folder.read(path);
        measures = measure(setting, moment.state, base, moment.events);
        plain.moments.push_back(std::move(moment.state));
    }
    const Numbers expected = numbers_of(plain, setting, base, measures);
    for (const char* name : {"rock_dilation_fraction", "antithetic_edge_foot_m",
                             "antithetic_edge_shift", "hinge_step_m", "born of fault 0"})
        EXPECT_TRUE(expected.contains(name)) << name;

    // The wall rests from 1.25 to 3.25 km of travel.
    constexpr double at = 1250.0, pause = 2000.0;
    Told paused{{}, base.motion};
    paused.motion.stages = {{.end = Travel(at), .speed = 1.0},
                            {.start = Travel(at),
                             .end = Travel(at + pause),
                             .start_position = Extension(at),
                             .slope = 0.0,
                             .speed = 1.0},
                            {.start = Travel(at + pause),
                             .end = Travel(1e4),
                             .start_position = Extension(at),
                             .speed = 1.0}};
    for (const State& state : told_by(plain.moments, [](double extension) {
             return extension < at + 1.0 ? extension : extension + pause;
         })) {
        paused.moments.push_back(state);
        if (std::abs(state.clock.extension.m - at) > 1.0)
            continue;
        for (double rest = 250.0; rest <= pause; rest += 250.0) {
            paused.moments.push_back(state);
            paused.moments.back().clock.travel = Travel(state.clock.travel.m + rest);
        }
        // In the pause everything is as it was when the wall came to rest.
        const auto first = plain.moments.begin();
        const Told before{{first, first + 6}, plain.motion};
        SCOPED_TRACE("in the pause");
        expect_equal(numbers_of({{paused.moments.begin(), paused.moments.end() - 3}, paused.motion},
                                setting, base, measures),
                     numbers_of(before, setting, base, measures));
    }
    {
        SCOPED_TRACE("after a pause");
        expect_equal(numbers_of(paused, setting, base, measures), expected);
    }

    // From there on at half the rate, and at four times the rate.
    for (const double slope : {0.5, 4.0}) {
        Told slower{told_by(plain.moments,
                            [&](double extension) {
                                return extension < at ? extension : at + (extension - at) / slope;
                            }),
                    base.motion};
        slower.motion.stages = {{.end = Travel(at), .speed = 1.0},
                                {.start = Travel(at),
                                 .end = Travel(1e4),
                                 .start_position = Extension(at),
                                 .slope = slope,
                                 .speed = 1.0}};
        SCOPED_TRACE(fmt::format("rate times {}", slope));
        expect_equal(numbers_of(slower, setting, base, measures), expected);
    }
}

} // namespace
} // namespace listric::two_clocks_test
