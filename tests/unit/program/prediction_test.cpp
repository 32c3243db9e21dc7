#include "apps/model/effects.hpp"
#include "apps/run/forecast/prediction.hpp"

#include <gtest/gtest.h>

namespace listric::prediction_test {

using namespace dem;
namespace {

Scene draft(const char* scene, const std::vector<std::string>& set = {},
            const std::vector<std::string>& without = {}) {
    SceneRequest request{.scene = scene, .set = set, .without = without};
    request.accuracy = "draft";
    return load_scene(request);
}

constexpr double rate = 9e7; // disc-steps per second
constexpr CycleSpeed one_thread{.team = rate, .one_thread = rate};

TEST(Prediction, CountsTheWorkOfTheScenes) {
    // Discs times cycles of runs with seed 1.
    const std::pair<const char*, double> runs[] = {
        {"lis1", 1.549e9}, {"rfr", 1.375e9}, {"lis1-elastic", 1.477e9}};
    for (const auto& [scene, disc_steps] : runs) {
        const Prediction p = predict(draft(scene), one_thread);
        EXPECT_NEAR(p.disc_steps, disc_steps, 0.1 * disc_steps) << scene;
    }
}

// The run that the prices of many discs come from, at the speed that `bench` measured after it
// (docs/record/2026-11/sandbox.md). A tenth is what two predictions in different minutes differ by.
TEST(Prediction, ManyDiscsTakeAsLongAsTheyTook) {
    SceneRequest request{.scene = "lis1",
                         .set = {"extension.speed_m_per_s=3", "extension.ramp_s=800"}};
    request.accuracy = "sandbox";
    const CycleSpeed two_threads{.team = 138e6, .one_thread = 75e6};
    const Prediction p = predict(load_scene(request), two_threads);
    const double genesis = 680.0, all_else = 7139.0; // s
    EXPECT_NEAR(p.seconds, genesis + all_else, 0.1 * (genesis + all_else));
    EXPECT_NEAR(p.forecast.before, genesis, 0.15 * genesis);
}

TEST(Prediction, FollowsTheSpeedOfTheMachine) {
    const Scene scene = draft("lis1");
    const double seconds = predict(scene, one_thread).seconds;
    EXPECT_NEAR(predict(scene, {.team = 0.5 * rate, .one_thread = 0.5 * rate}).seconds,
                2.0 * seconds, 1e-9 * seconds);
    // Two threads of the same speed each: the cycle takes half the time, the rest what it took.
    const double two = predict(scene, {.team = 2.0 * rate, .one_thread = rate}).seconds;
    EXPECT_LT(two, 0.8 * seconds);
    EXPECT_GT(two, 0.5 * seconds);
}

TEST(Prediction, KnowsThePriceOfEffects) {
    const double all = predict(draft("lis1"), one_thread).seconds;
    for (const char* effect : {"fault_weakening", "bond_healing", "compaction"})
        EXPECT_LT(predict(draft("lis1", {}, {effect}), one_thread).seconds, all) << effect;
    EXPECT_LT(predict(draft("lis1", {}, {"compaction", "sedimentation"}), one_thread).seconds,
              0.9 * all);
    // All pictures but the last are drawn beside the cycle.
    EXPECT_LT(predict(draft("lis1", {"output.figures_at_m=[]"}), one_thread).seconds, all);
    EXPECT_GT(predict(draft("lis1-elastic"), one_thread).seconds, 1.05 * all);
}

TEST(Prediction, SmallDiscsAmongLargeOnesTakeLongToLayDown) {
    // Measured: ten times as long at a ratio of 10 (sedimentation.cpp).
    const auto per_event = [](const char* ratio) {
        const std::string radii = std::string("hanging_wall.radius_ratio=") + ratio;
        const auto seconds = [&](const char* interval) {
            return predict(draft("lis1", {radii, interval}), one_thread).seconds;
        };
        return seconds("sedimentation.interval_a=500") - seconds("sedimentation.interval_a=1000");
    };
    EXPECT_GT(per_event("10"), 8.0 * per_event("1.66"));
}

TEST(Prediction, LightSedimentShortensTheStepWhereMassesHaveNoFloor) {
    const auto step = [](const std::vector<std::string>& set) {
        return predict(draft("lis1", set), one_thread).time_step;
    };
    const std::string light = "sedimentation.surface_porosity=0.9",
                      none = "cycle.inertial_mass_floor=0";
    EXPECT_EQ(step({light}), step({}));
    EXPECT_NEAR(step({light, none}), std::sqrt(0.2) * step({none}), 1e-9); // 0.1 instead of 0.5
}

TEST(Prediction, FillingToAHighLevelIsForeseen) {
    const auto end = [](const std::vector<std::string>& set) {
        return static_cast<double>(predict(draft("lis1", set)).discs_at_end);
    };
    const double none = end({});
    EXPECT_EQ(end({"sedimentation.level_m=-500"}), none);
    const double filled = end({"sedimentation.level_m=20000"}) - none;
    // Above 50 km of surface, at the end; a disc of draft has pi (183 m)^2 / 0.825.
    EXPECT_NEAR(filled, 20e3 * 50e3 / (3.1416 * 183.0 * 183.0 / 0.825), 0.1 * filled);
    EXPECT_NEAR(end({"sedimentation.target=[[0.0, 0.0], [50000.0, 40000.0]]"}) - none, filled,
                0.01 * filled);
    EXPECT_NEAR(end({"sedimentation.target=[{time_a=0.0, points=[[0.0, 20000.0]]}, {time_a=1e6, "
                     "points=[[0.0, -5.0]]}]"}) -
                    none,
                filled, 1e-9 * filled);
    EXPECT_GT(predict(draft("lis1", {"sedimentation.level_m=20000"}), one_thread).seconds,
              2.0 * predict(draft("lis1"), one_thread).seconds);
}

TEST(Prediction, SnapshotsAndTheirDiskAreForeseen) {
    const auto of = [](const std::vector<std::string>& set) { return predict(draft("lis1", set)); };
    EXPECT_EQ(of({}).snapshots, 21.0);
    const Prediction fine = of({"output.interval_m=0.5"});
    EXPECT_EQ(fine.snapshots, 20001.0);
    EXPECT_NEAR(fine.disk, of({}).disk * 20001.0 / 21.0, 1e-6 * fine.disk);
    EXPECT_LT(of({"output.series=none"}).disk, of({}).disk);
    // No more than there are cycles.
    const Prediction finest = of({"output.interval_m=0.001"});
    EXPECT_LE(finest.snapshots, finest.cycles + 1.0);
}

// A lattice of as many discs as that would take 600 TB.
TEST(Prediction, SpeedIsMeasuredOnNoMoreDiscsThanTellIt) {
    EXPECT_GT(measure_speed(std::size_t{1} << 40, 1, 0.01, false).team, 0.0);
}

} // namespace
} // namespace listric::prediction_test
