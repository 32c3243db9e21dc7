// A run with every effect gives the recorded state, to the last bit: in every build, with the plain
// and the fast cycle, with one thread or three. The record, every-effect.hash, changes only with a
// change of results, which the commit explains.
//
// Sines, exponentials and the like are the C library's, which on processors without fused
// multiply-add takes other code with other last bits: there the record may not hold.

#include "tests/program.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace listric::recorded_hash_test {

using namespace dem;
namespace {

using namespace support;

class RecordedHash : public SceneRuns {
protected:
    std::string hash_of(int threads, bool plain, const std::vector<std::string>& set = {}) const {
        RunOptions o = options("run");
        o.threads = threads;
        o.plain = plain;
        o.force = true;
        return run(load_scene({.scene = test_scene("every-effect.toml"), .set = set}),
                   o)["state_hash"];
    }

    /// The recorded hash of that name.
    static std::string recorded(const std::string& name) {
        std::istringstream lines(contents(test_scene("every-effect.hash")));
        for (std::string key, hash; lines >> key >> hash;)
            if (key == name)
                return hash;
        return "not recorded";
    }
};

TEST_F(RecordedHash, HoldsForEveryCycleAndNumberOfThreads) {
    EXPECT_EQ(hash_of(1, true), recorded("state")) << "plain";
    for (int threads : {1, 2, 3})
        EXPECT_EQ(hash_of(threads, false), recorded("state")) << threads << " threads";
}

TEST_F(RecordedHash, HoldsForTheAccountOfEnergy) {
    EXPECT_EQ(hash_of(2, false, {"energy={}"}), recorded("state_and_energy"));
}

// every-effect-begun is the folder of a run to 100 m by version 0.1.0+e8998d0, whose snapshot shall
// stay good: users resume by a newer program.
TEST_F(RecordedHash, HoldsForARunThatAnEarlierVersionBegan) {
    RunOptions o = options("run");
    std::filesystem::copy(test_scene("every-effect-begun"), o.output,
                          std::filesystem::copy_options::recursive);
    o.resume = true;
    const auto summary = run(load_scene({.scene = test_scene("every-effect.toml")}), o);
    EXPECT_EQ(summary["state_hash"], recorded("state"));
}

// That version took Table 1's fault rock where a scene names none; the run goes on with it.
TEST_F(RecordedHash, HoldsForARunThatAnEarlierVersionBeganWithItsDefaultRock) {
    std::string text = contents(test_scene("every-effect.toml"));
    const std::string named = "[materials]\nweakened = \"mat18-w\"\n";
    ASSERT_NE(text.find(named), text.npos);
    text.erase(text.find(named), named.size());
    const auto file = folder / "every-effect.toml", output = folder / "begun";
    std::ofstream(file) << text;
    std::filesystem::copy(test_scene("every-effect-begun"), output,
                          std::filesystem::copy_options::recursive);
    const auto resume = [&] {
        return Program(folder, {"run", file, "--output", output, "--resume", "--no-report"}).wait();
    };
    const Ended ended = resume();
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.err, testing::HasSubstr("names no rock: the run goes on with the one that"));
    EXPECT_EQ(nlohmann::json::parse(contents(output / "summary.json"))["state_hash"],
              recorded("state"));
    EXPECT_EQ(resume().code, 0) << "finished";
    // A new run of the scene has the rock of the shipped scenes.
    EXPECT_NE(run(load_scene({.scene = file}), options("new"))["state_hash"], recorded("state"));
}

} // namespace
} // namespace listric::recorded_hash_test
