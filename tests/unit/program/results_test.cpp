// Lines of results at the end of a run.

#include "apps/run/results.hpp"

#include "apps/support/words/log.hpp"
#include "tests/small_halfgraben.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace listric::results_test {
namespace {

using namespace measures;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

Measures good_measures() {
    Measures m;
    m.basin_area = 147.6e6;
    return m;
}

/// Checks of a good summary at 10 km with these numbers changed.
std::vector<archive::QualityCheck> checks_of(const JsonObject& changes = JsonObject::object()) {
    JsonObject summary{{"quasi_static", true},
                       {"mass_error_fraction", 2e-15},
                       {"area_balance", 0.984},
                       {"extension_m", 10e3}};
    summary.update(changes);
    return archive::quality_checks(summary, {});
}

TEST(Results, SayWhatTheRunHasComeTo) {
    Measures m = good_measures();
    m.rollover_tilt = 38.12;
    m.cutoff = {9300.0, 3200.0};
    m.area_balance = 0.984;
    m.depocentres = {{3200.0, 4120.0, 900.0}, {14600.0, 2310.0, 400.0}};
    FaultReport faults;
    faults.faults.resize(2);
    faults.faults[0].trace.points = {{17.9e3, -500.0}, {15e3, -9e3}};
    faults.faults[0].dip = 61.3;
    faults.faults[0].cutoffs[0] = {.hanging = {0.0, -1247.0}, .is_resolved = true};
    faults.faults[1].trace.points = {{12e3, -500.0}, {15e3, -9e3}};
    faults.faults[1].dip = 55.0;
    faults.main_antithetic = 0;
    faults.main_synthetic = 1;
    EXPECT_THAT(
        result_lines({m, faults, 7120.0, checks_of({{"volume_error_fraction", 3e-4}})}),
        ElementsAre("tilt of the head block 38.1 degrees; cutoff at x = 9.3 km, 3.2 km deep",
                    "basin 147.6 km2, 7.1 km deep; area balance 0.98",
                    "2 depocentres: 4.1 km of sediment at x = 3.2 km, 2.3 km of sediment at x = "
                    "14.6 km",
                    "main faults: antithetic at x = 17.9 km, dip 61 degrees, throw 1.2 km; "
                    "synthetic at x = 12.0 km, dip 55 degrees",
                    "good: quasi-static, mass error 2e-15, volume error 0.03 %, areas balance"));
}

TEST(Results, AreFewerWhereLessIsInTheScene) {
    EXPECT_THAT(result_lines({good_measures(), {}, {}, {}}),
                ElementsAre("basin 147.6 km2", "no fault is traced in the last window"));
    FaultReport minor;
    minor.faults.resize(3);
    EXPECT_THAT(result_lines({good_measures(), minor, {}, {}})[1],
                StartsWith("3 faults are traced, but none is a main one"));
}

TEST(Results, SayHowMuchOfWhatIsWeakenedIsOfNoFault) {
    FaultReport report;
    report.weak_off_fault_fraction = 0.126;
    EXPECT_EQ(result_lines({good_measures(), report, {}, {}})[1],
              "no fault is traced in the last window; 13 % of what is weakened is of no fault");
    report.weak_off_fault_fraction = 0.0;
    EXPECT_EQ(result_lines({good_measures(), report, {}, {}})[1],
              "no fault is traced in the last window");
}

TEST(Results, SayWhatIsDoubtfulAndWhy) {
    const auto lines =
        result_lines({good_measures(), {}, {}, checks_of({{"quasi_static", false}})});
    EXPECT_THAT(lines[lines.size() - 2], StartsWith("doubtful: not quasi-static, mass error"));
    EXPECT_THAT(lines.back(), HasSubstr("halve extension.speed_m_per_s"));
    EXPECT_THAT(
        result_lines({good_measures(), {}, {}, checks_of({{"volume_error_fraction", 2e-3}})})
            .back(),
        HasSubstr("update_interval_a"));
}

TEST(Results, LogHasTimesAndRepeatsItsWarnings) {
    const auto file = std::filesystem::path(testing::TempDir()) / "listric-results-log.txt";
    std::filesystem::remove(file);
    {
        testing::internal::CaptureStderr();
        Log log(file, true);
        log.say("begun");
        log.say("warning: too fast");
        log.repeat_warnings();
        log.repeat_warnings();
        // A quiet log hides no warning, and says it once.
        EXPECT_EQ(testing::internal::GetCapturedStderr(),
                  fmt::format("listric: warning: {}: too fast\n", file.parent_path().string()));
    }
    std::string text = support::contents(file);
    std::filesystem::remove(file);
    const std::string time = "[0-9]{4}-[0-9]{2}-[0-9]{2} [0-9]{2}:[0-9]{2}:[0-9]{2}  ";
    EXPECT_THAT(text, MatchesRegex(time + "begun\n" + time + "warning: too fast\n" + time +
                                   "there was a warning:\n" + time + "  warning: too fast\n"));
}

} // namespace
} // namespace listric::results_test
