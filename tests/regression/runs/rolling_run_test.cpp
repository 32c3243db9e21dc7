// Runs whose discs resist rolling: equal bits however they are cut, and a memory that is saved.

#include "apps/scene/scene_file.hpp"
#include "dem/rolling.hpp"
#include "tests/message_of.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace listric::rolling_run_test {

namespace {

using namespace support;

class RollingRun : public SceneRuns {
protected:
    Scene scene(std::vector<std::string> set) const {
        set.emplace_back("extension.distance_m=100.0");
        return load(contents(test_scene("every-effect.toml")), set);
    }
    const std::vector<std::string> sand{"material.friction=0.6", "material.rolling_friction=0.3",
                                        "sedimentation.rolling_friction=0.2"};
};

TEST_F(RollingRun, IsOneRunHoweverItIsCut) {
    const Scene rolling = scene(sand);
    const auto whole = run(rolling, "whole");
    RunOptions plain = options("plain");
    plain.plain = true;
    EXPECT_EQ(run(rolling, plain)["state_hash"], whole["state_hash"]) << "plain cycle";
    EXPECT_EQ(run(rolling, "two", {}, false, 2)["state_hash"], whole["state_hash"]) << "threads";
    run(rolling, "cut", 40.0);
    EXPECT_EQ(run(rolling, "cut", {}, true)["state_hash"], whole["state_hash"]) << "resumed";
    EXPECT_NE(run(scene({"material.friction=0.6"}), "free")["state_hash"], whole["state_hash"]);
}

TEST_F(RollingRun, WhatItWritesDownStandsAlone) {
    const std::string written = to_toml(scene(sand));
    const Scene again = load(written);
    EXPECT_EQ(to_toml(again), written);
    EXPECT_EQ(again.basement.rolling_friction, 0.3);
    EXPECT_EQ(make_parts(again).materials[dem::sediment].rolling_friction, 0.2);
    EXPECT_THAT(message_of<SceneError>([&] { scene({"material.rolling_friction=-1"}); }),
                testing::HasSubstr("rolling_friction: out of range (-1)"));
}

} // namespace
} // namespace listric::rolling_run_test
