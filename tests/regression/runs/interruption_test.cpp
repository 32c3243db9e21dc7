// Ctrl-C, and memory that does not suffice: every call that lasts ends in order, with its exit
// code.

#include "apps/laboratory/laboratory.hpp"
#include "apps/support/error.hpp"
#include "tests/program.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <sys/resource.h>
#include <thread>

namespace listric::interruption_test {
namespace {

namespace fs = std::filesystem;
using support::contents;
using support::Ended;
using support::Program;
using testing::AllOf;
using testing::HasSubstr;
using namespace std::chrono_literals;

const std::string scene = support::small_halfgraben() + R"([extension]
distance_m = 2000.0
speed_m_per_s = 0.5
ramp_s = 2.0
[output]
interval_m = 20.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
)";

const std::string plan = R"([[run]]
name = "small"
scene = "small"
at_m = [40, 2000]
[[experiment]]
name = "one"
title = "One"
runs = "small"
expect = [{measure = "extension_m", what = "reached", least = 1, source = "scene"}]
)";

class InterruptionTest : public testing::Test {
protected:
    fs::path folder = fs::path(testing::TempDir()) /
                      fmt::format("listric-stop-{}-{}", getpid(),
                                  testing::UnitTest::GetInstance()->current_test_info()->name());
    InterruptionTest() {
        fs::create_directories(folder / "scenes");
        std::ofstream(folder / "scenes/small.toml") << scene;
        std::ofstream(folder / "plan.toml") << plan;
        setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
        setenv("LISTRIC_SCENES", (folder / "scenes").c_str(), 1);
    }
    ~InterruptionTest() override {
        unsetenv("LISTRIC_SCENES");
        unsetenv("XDG_CACHE_HOME");
        fs::remove_all(folder);
    }
    fs::path output() const { return folder / "out"; }

    /// Starts a call, sends Ctrl-C once something is true, and waits for its end, which must come
    /// soon.
    Ended interrupt(std::vector<std::string> words, const std::function<bool()>& is_time) {
        const Program program(folder, std::move(words));
        const auto start = std::chrono::steady_clock::now();
        while (program.runs() && !is_time() && std::chrono::steady_clock::now() - start < 120s)
            std::this_thread::sleep_for(5ms);
        EXPECT_TRUE(program.runs()) << "ended before it could be interrupted";
        const auto asked = std::chrono::steady_clock::now();
        program.send(SIGINT);
        const Ended ended = program.wait();
        EXPECT_LT(std::chrono::steady_clock::now() - asked, 30s);
        return ended;
    }

    /// True from a while after the output is there.
    std::function<bool()> after_output(std::chrono::milliseconds pause) const {
        return [this, pause, seen = std::chrono::steady_clock::time_point()]() mutable {
            if (seen == std::chrono::steady_clock::time_point() && fs::exists(output()))
                seen = std::chrono::steady_clock::now();
            return seen != std::chrono::steady_clock::time_point() &&
                   std::chrono::steady_clock::now() - seen > pause;
        };
    }
};

TEST_F(InterruptionTest, ARunSaysHowToGoOn) {
    const Ended ended =
        interrupt({"run", "small", "--output", output().string()}, after_output(300ms));
    EXPECT_EQ(ended.code, 130) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("--resume"));
}

TEST_F(InterruptionTest, TheLaboratoryStopsInSamplesAndInTests) {
    for (const auto& [pause, discs] : {std::pair(300ms, "20000"), std::pair(1500ms, "239")}) {
        const Ended ended = interrupt({"laboratory", "biaxial", "mat18-b", "--discs", discs,
                                       "--seeds", "20", "--output", output().string()},
                                      after_output(pause));
        EXPECT_EQ(ended.code, 130) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr("interrupted"));
        fs::remove_all(output());
    }
}

TEST_F(InterruptionTest, TheSlabsOfPureShearStop) {
    unsetenv("LISTRIC_SCENES"); // its scene is one that ships with the program
    const Ended ended = interrupt(
        {"laboratory", "pure-shear", "mat18-b", "--discs", "60", "--seeds", "1", "--speed", "4",
         "--confining", "10,50", "--output", output().string()},
        [&] {
            return fs::exists(output() / "slab-weakening-1e-13-healing-1e-15-seed-1/scene.toml");
        });
    EXPECT_EQ(ended.code, 130) << ended.err;
}

TEST_F(InterruptionTest, ACalibrationKeepsItsMeasurements) {
    const fs::path history = output() / "history.json";
    const Ended ended =
        interrupt({"calibrate", "--discs", "60", "--seeds", "1", "--output", output().string()},
                  [&] { return fs::exists(history); });
    EXPECT_EQ(ended.code, 130) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("--resume"));
    EXPECT_GE(nlohmann::json::parse(contents(history)).size(), 1u);
}

TEST_F(InterruptionTest, StudiesStop) {
    for (const char* name : {"resolution", "time-step"}) {
        std::vector<std::string> call{"study", name,       "--scene",
                                      "small", "--output", output().string()};
        if (name == std::string("resolution"))
            call.insert(call.end(), {"--values", "60,90"});
        const Ended ended = interrupt(call, after_output(300ms));
        EXPECT_EQ(ended.code, 130) << name << ' ' << ended.err;
        EXPECT_THAT(ended.err, HasSubstr("the same call goes on")) << name;
        fs::remove_all(output());
    }
}

TEST_F(InterruptionTest, AValidationStops) {
    const Ended ended =
        interrupt({"validate", "--plan", (folder / "plan.toml").string(), "--runs",
                   (folder / "runs").string(), "--output", (output() / "report.md").string()},
                  [&] { return fs::exists(folder / "runs/small-1/scene.toml"); });
    EXPECT_EQ(ended.code, 130) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("the same call goes on"));
    EXPECT_FALSE(fs::exists(output() / "report.md"));
}

TEST_F(InterruptionTest, WhatKeepsNothingEndsAtOnce) {
    const auto start = std::chrono::steady_clock::now();
    const Ended ended = interrupt({"bench", "--steps", "100000000"},
                                  [&] { return std::chrono::steady_clock::now() - start > 500ms; });
    EXPECT_EQ(ended.code, 130) << ended.err;
}

// In-process: the flag, and not the signal, is what stops.
TEST_F(InterruptionTest, AFlagStopsCalibrationAndLaboratory) {
    std::atomic<bool> flag = false;
    CalibrationRequest calibration;
    calibration.discs = 60;
    calibration.seeds = 1;
    calibration.output = output();
    calibration.stop = StopToken(flag);
    std::jthread asks([&] {
        while (!fs::exists(output() / "history.json"))
            std::this_thread::sleep_for(5ms);
        flag = true;
    });
    EXPECT_THROW(run_calibration(calibration), Interrupted);
    LaboratoryRequest laboratory;
    laboratory.test = "uniaxial";
    laboratory.material = "mat18-b";
    laboratory.output = folder / "uniaxial";
    laboratory.quiet = true;
    laboratory.threads = 2;
    laboratory.stop = StopToken(flag);
    EXPECT_THROW(run_laboratory(laboratory), Interrupted);
}

struct Shortage {
    rlim_t most; ///< address space, bytes
    std::vector<std::string> words;
};

TEST_F(InterruptionTest, MemoryThatDoesNotSufficeSaysHowMuchIsNeeded) {
    const std::string out = output().string();
    for (const auto& [most, words] :
         {Shortage{400'000'000,
                   {"run", "small", "--set", "hanging_wall.mean_radius_m=1", "--force-size",
                    "--output", out}}, // whether or not the disk has room for it
          Shortage{400'000'000, {"bench", "--discs", "3000000", "--threads", "2"}},
          Shortage{90'000'000,
                   {"laboratory", "uniaxial", "mat18-b", "--discs", "100000", "--seeds", "4",
                    "--threads", "4", "--output", out + "-uniaxial"}}}) {
        const auto limit = [most = most] {
            const rlimit memory{most, most};
            const rlimit seconds{60, 60}; // should memory suffice
            setrlimit(RLIMIT_AS, &memory);
            setrlimit(RLIMIT_CPU, &seconds);
        };
        const Ended ended = Program(folder, words, limit).wait();
        EXPECT_EQ(ended.code, 4) << words[0] << ": " << ended.err;
        EXPECT_THAT(ended.err, AllOf(HasSubstr("memory is short"), HasSubstr(" MB"))) << words[0];
    }
}

} // namespace
} // namespace listric::interruption_test
