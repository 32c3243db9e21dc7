#include "apps/archive/quality.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace listric::quality_test {

using namespace archive;
namespace {

JsonObject good_run() {
    return {{"extension_m", 10000.0},
            {"quasi_static", true},
            {"unbalanced_ratio_mean", 9.6e-4},
            {"inertial_number", 6e-4},
            {"mass_error_fraction", 8.9e-15},
            {"volume_error_fraction", 5.8e-4},
            {"area_balance", 0.981},
            {"sediment_stress_ratio", 1.0},
            {"faults", {{{"width_diameters", 2.4}}, {{"width_diameters", 3.1}}}}};
}

std::vector<QualityCheck> checks_of(const JsonObject& summary, bool base_moves = false) {
    return quality_checks(summary, {.base_moves = base_moves, .mean_radius = 93.1});
}

QualityCheck check_named(const std::vector<QualityCheck>& checks, const std::string& key) {
    const auto found = std::ranges::find(checks, key, &QualityCheck::key);
    return found == checks.end() ? QualityCheck() : *found;
}

TEST(Quality, AsksEveryQuestionOfAGoodRun) {
    const auto checks = checks_of(good_run());
    std::vector<std::string> keys, values, bounds;
    for (const QualityCheck& check : checks) {
        keys.push_back(check.key);
        values.push_back(check.value);
        bounds.push_back(check.bound);
        EXPECT_NE(check.verdict, QualityVerdict::doubtful) << check.key;
        EXPECT_THAT(check.words, testing::EndsWith(".")) << check.key;
    }
    EXPECT_THAT(keys,
                testing::ElementsAre("quasi_static", "mass_error_fraction", "volume_error_fraction",
                                     "area_balance", "width_diameters", "sediment_stress_ratio"));
    EXPECT_THAT(values, testing::ElementsAre("unbalanced 0.00096, inertial 0.0006", "error 9e-15",
                                             "error 0.058 %", "0.981", "2.4 to 3.1", "1.00"));
    EXPECT_THAT(bounds,
                testing::ElementsAre("at most 0.01, 0.002", "below 1e-12", "below 0.1 %",
                                     "0.95 to 1.03", "5 to interpret", "lis1: 0.96 to 1.12"));
}

TEST(Quality, FrictionThatNothingUsesIsTold) {
    JsonObject run = good_run();
    run["ramp_mobilised_friction"] = 0.11;
    run["ramp_sliding_share"] = 0.004;
    run["flat_mobilised_friction"] = -0.02;
    run["flat_sliding_share"] = 0.0;
    const auto checks_with = [&](std::optional<double> friction) {
        return quality_checks(run, {.mean_radius = 93.1, .base_friction = friction});
    };
    EXPECT_EQ(check_named(checks_with({}), "flat_mobilised_friction").value, "");
    const QualityCheck idle = check_named(checks_with(0.5), "flat_mobilised_friction");
    EXPECT_EQ(idle.value, "ramp 0.11, 0 % slides; flat 0.02, 0 % slides");
    EXPECT_EQ(idle.bound, "at most 0.5");
    EXPECT_EQ(idle.verdict, QualityVerdict::note);
    EXPECT_THAT(idle.words, testing::StartsWith("A higher friction of the base changes nothing"));
    EXPECT_THAT(verdict_lines(checks_with(0.5))[0],
                testing::HasSubstr("the base's friction of 0.5 is not mobilised (ramp 0.11"));
    run["ramp_sliding_share"] = 0.6;
    EXPECT_EQ(check_named(checks_with(0.5), "flat_mobilised_friction").brief, "");
}

TEST(Quality, StillGroundKeepsItsLevel) {
    JsonObject run = good_run();
    for (const auto& [rise, verdict] :
         {std::pair(46.0, QualityVerdict::good), std::pair(-47.0, QualityVerdict::doubtful)}) {
        run["still_ground_m"] = rise; // half a radius of 93.1 m
        EXPECT_EQ(check_named(checks_of(run), "still_ground_m").verdict, verdict) << rise;
        EXPECT_EQ(check_named(checks_of(run, true), "still_ground_m").verdict,
                  QualityVerdict::note);
    }
    EXPECT_THAT(verdict_lines(checks_of(run))[0], testing::HasSubstr("still ground moves"));
}

TEST(Quality, WhatRockUnloadedIsNoLossOfArea) {
    JsonObject run = good_run();
    run["area_balance"] = 0.93;
    EXPECT_EQ(check_named(checks_of(run), "area_balance").verdict, QualityVerdict::doubtful);
    run["elastic_area_fraction"] = 0.03;
    const QualityCheck check = check_named(checks_of(run), "area_balance");
    EXPECT_EQ(check.verdict, QualityVerdict::good);
    EXPECT_EQ(check.value, "0.930, 0.960 as if rock were rigid");
}

TEST(Quality, EveryBoundCanBeMissed) {
    const std::pair<const char*, JsonObject> bad[] = {{"quasi_static", false},
                                                      {"mass_error_fraction", 1e-12},
                                                      {"volume_error_fraction", 1e-3},
                                                      {"area_balance", 0.949},
                                                      {"area_balance", 1.031}};
    for (const auto& [key, value] : bad) {
        JsonObject summary = good_run();
        summary[key] = value;
        for (const QualityCheck& check : checks_of(summary))
            EXPECT_EQ(check.verdict == QualityVerdict::doubtful, check.key == key)
                << key << check.key;
    }
}

TEST(Quality, OneVerdictIsToldEverywhere) {
    EXPECT_EQ(verdict_of(checks_of(good_run())), QualityVerdict::good);
    EXPECT_THAT(verdict_lines(checks_of(good_run())),
                testing::ElementsAre("good: quasi-static, mass error 9e-15, volume error 0.058 %, "
                                     "areas balance"));
    JsonObject leaky = good_run();
    leaky["volume_error_fraction"] = 1.6e-3;
    EXPECT_EQ(verdict_of(checks_of(leaky)), QualityVerdict::doubtful);
    EXPECT_THAT(verdict_lines(checks_of(leaky)),
                testing::ElementsAre(testing::StartsWith("doubtful: quasi-static"),
                                     testing::HasSubstr("update_interval_a")));
    EXPECT_TRUE(verdict_lines({}).empty()); // nothing is judged
}

TEST(Quality, AreasAreNotJudgedWhereTheirBoundsDoNotHold) {
    JsonObject summary = good_run();
    summary["area_balance"] = 0.6;
    EXPECT_EQ(check_named(checks_of(summary, true), "area_balance").verdict, QualityVerdict::note);
    summary["extension_m"] = 4999.0;
    EXPECT_EQ(check_named(checks_of(summary), "area_balance").verdict, QualityVerdict::note);
    summary["extension_m"] = 4999.992; // of a run to 5 km, whose cycles make 0.02 m each
    summary["cycles"] = 249999.6;
    EXPECT_EQ(check_named(checks_of(summary), "area_balance").verdict, QualityVerdict::doubtful);
    summary["extension_m"] = 5000.0;
    EXPECT_EQ(check_named(checks_of(summary), "area_balance").verdict, QualityVerdict::doubtful);
}

TEST(Quality, SaysWhatIsTooNarrowAndLeavesOutWhatARunHasNot) {
    EXPECT_THAT(check_named(checks_of(good_run()), "width_diameters").words,
                testing::HasSubstr("5 discs, 930 m."));
    EXPECT_TRUE(checks_of({}).empty());
    EXPECT_TRUE(checks_of(JsonObject()).empty());
    EXPECT_TRUE(checks_of({{"faults", 3}, {"quasi_static", "yes"}, {"area_balance", "x"}}).empty());
    JsonObject dry = good_run();
    dry.erase("sediment_stress_ratio");
    dry["faults"] = JsonObject::array();
    EXPECT_EQ(checks_of(dry).size(), 4u);
}

TEST(Quality, APauseIsToBeARest) {
    JsonObject run = good_run();
    EXPECT_EQ(check_named(checks_of(run), "rest_strain_windows").key, ""); // no pause
    for (const auto& [windows, verdict] :
         {std::pair(0.15, QualityVerdict::good), std::pair(0.16, QualityVerdict::doubtful)}) {
        run["rest_strain_windows"] = windows;
        EXPECT_EQ(check_named(checks_of(run), "rest_strain_windows").verdict, verdict);
    }
}

TEST(Quality, StepsOfAPauseAreToEndAtRest) {
    JsonObject run = good_run();
    EXPECT_EQ(check_named(checks_of(run), "unsettled_steps").key, "");
    run["steps"] = 60;
    for (const auto& [unsettled, verdict] :
         {std::pair(0, QualityVerdict::good), std::pair(1, QualityVerdict::doubtful)}) {
        run["unsettled_steps"] = unsettled;
        EXPECT_EQ(check_named(checks_of(run), "unsettled_steps").verdict, verdict);
    }
    EXPECT_EQ(check_named(checks_of(run), "unsettled_steps").value, "1 of 60 steps without rest");
}

} // namespace
} // namespace listric::quality_test
