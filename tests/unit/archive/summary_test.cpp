// Names and signs of what summary.json says about faults: they are part of the program's contract.

#include "apps/archive/folder/summary.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace listric::summary_test {

using namespace dem;
using namespace measures;
namespace {

using nlohmann::json;

json summary(const FaultReport& report) {
    return json::parse(archive::summary_json({.state = empty_state(),
                                              .record = {},
                                              .measures = {},
                                              .faults = report,
                                              .wall_seconds = 1.0}));
}

TEST(Summary, Faults) {
    Fault fault;
    fault.trace.points = {{1000.0, -500.0}, {1300.0, -900.0}, {1600.0, -1300.0}};
    fault.normal = false;
    fault.synthetic = false;
    fault.foot = {2000.0, -2000.0};
    fault.cutoffs = {{-1, {{0.0, -350.0}, {0.0, 0.0}, 20.0, true}},
                     {0, {{0.0, -300.0}, {0.0, 0.0}, 10.0, true}},
                     {2, {{0.0, -200.0}, {0.0, 0.0}, 500.0, false}},
                     {3, {{0.0, -100.0}, {0.0, 0.0}, 30.0, true}}};
    FaultReport report;
    report.faults = {fault};
    report.main_antithetic = 0;
    report.antithetic_foot = 1500.0;
    report.width = 2.5;
    report.sediment_weak_off_fault_fraction = 0.05;
    const json all = summary(report);
    EXPECT_EQ(all["fault_width_diameters"], 2.5);
    EXPECT_EQ(all["antithetic_foot_x_m"], 1500.0);
    EXPECT_EQ(all["main_antithetic_fault"], 0);
    EXPECT_FALSE(all.contains("main_synthetic_fault"));
    EXPECT_EQ(all["sediment_weak_off_fault_fraction"], 0.05);
    ASSERT_EQ(all["faults"].size(), 1u);
    const json& f = all["faults"][0];
    EXPECT_EQ(f["x_top_m"], 1000.0);
    EXPECT_EQ(f["z_top_m"], 500.0); // depth
    EXPECT_EQ(f["x_bottom_m"], 1600.0);
    EXPECT_EQ(f["z_bottom_m"], 1300.0);
    EXPECT_EQ(f["length_m"], 1000.0);
    EXPECT_EQ(f["sense"], "reverse");
    EXPECT_EQ(f["attitude"], "antithetic");
    EXPECT_EQ(f["foot_z_m"], 2000.0);
    EXPECT_EQ(f["throw_m"], json({{"-1", 350.0}, {"0", 300.0}, {"3", 100.0}}));
    EXPECT_EQ(f["throw_error_m"], json({{"-1", 20.0}, {"0", 10.0}, {"3", 30.0}}));
    EXPECT_EQ(f["greatest_throw_m"], 350.0);
    EXPECT_EQ(f["points_m"].size(), 3u);
    for (const char* name : {"dip_deg", "rate_mm_per_a", "width_diameters", "curvature_per_m",
                             "born_at_m", "dip_at_birth_deg", "footwall_turn_deg", "foot_x_m"})
        EXPECT_TRUE(f.contains(name)) << name;
}

TEST(Summary, WithoutFaults) {
    const json all = summary({});
    EXPECT_TRUE(all["faults"].empty());
    for (const char* name : {"fault_width_diameters", "antithetic_foot_x_m",
                             "main_antithetic_fault", "sediment_weak_off_fault_fraction"})
        EXPECT_FALSE(all.contains(name)) << name;
}

TEST(Summary, WhatEffectsAdd) {
    const nlohmann::ordered_json provenance{{"version", "0.2.0"}};
    const json all = json::parse(archive::summary_json({
        .state = empty_state(),
        .record = {},
        .measures = {},
        .faults = {},
        .effects = {"tides"},
        .numbers = {{"tide_m", 2.5}, {"never_measured_m", std::nan("")}},
        .objects = {{"tide_by_moon_m", {{"io", 1.0}, {"europa", 1.5}}}},
        .lists = {{"shores", {{{"x_m", 3.0}}, {{"x_m", 4.0}}}}},
        .wall_seconds = 1.0,
        .provenance = &provenance,
    }));
    EXPECT_EQ(all["provenance"]["version"], "0.2.0");
    EXPECT_EQ(all["effects"], json({"tides"}));
    EXPECT_EQ(all["tide_m"], 2.5);
    EXPECT_FALSE(all.contains("never_measured_m"));
    EXPECT_EQ(all["tide_by_moon_m"], json({{"io", 1.0}, {"europa", 1.5}}));
    EXPECT_EQ(all["shores"][1]["x_m"], 4.0);
}

} // namespace
} // namespace listric::summary_test
