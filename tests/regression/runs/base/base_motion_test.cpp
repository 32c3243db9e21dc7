// A detachment that moves as prescribed, from the scene to the discs.

#include "dem/base/motion.hpp"
#include "dem/base/place.hpp"
#include "tests/message_of.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace listric::base_motion_test {

using namespace dem;
namespace {

namespace fs = std::filesystem;
using namespace support;
using testing::HasSubstr;

const std::string scene = small_halfgraben() + R"([extension]
distance_m = 20.0
[output]
interval_m = 10.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
)";

class BaseMotionRun : public SceneRuns {
protected:
    Scene load(const std::string& more, const std::vector<std::string>& set = {}) const {
        return SceneRuns::load(scene + more, set);
    }

    std::string refusal(const std::string& more, const std::vector<std::string>& set = {}) const {
        return support::message_of<SceneError>([&] { load(more, set); }, "");
    }

    State last_state(const std::string& name) const {
        return read_snapshot(list_snapshots(folder / name).back()).state;
    }
};

constexpr const char* even_uplift = R"([base_motion]
uplift = [{time_a = 0.0, points = [[0.0, 7.0]]}, {time_a = 1000.0, points = [[0.0, 17.0]]}]
)";

TEST_F(BaseMotionRun, EvenUpliftMovesAllDiscs) {
    run(load(""), "rigid");
    run(load(even_uplift), "moved");
    const State rigid = last_state("rigid"), moved = last_state("moved");
    const ConstDiscColumns a = disc_columns(rigid), b = disc_columns(moved);
    std::map<std::int64_t, double> before;
    for (std::size_t i = 0; i < a.id.size(); ++i)
        before[a.id[i]] = a.y[i];
    std::vector<double> lifts;
    for (std::size_t i = 0; i < b.id.size(); ++i)
        lifts.push_back(b.y[i] - before.at(b.id[i]));
    std::ranges::sort(lifts);
    const double mean = std::reduce(lifts.begin(), lifts.end()) / static_cast<double>(lifts.size());
    const std::size_t few = lifts.size() / 100;
    std::printf("discs lifted by %.3f m, from %.3f to %.3f\n", mean, lifts.front(), lifts.back());
    // 10 m of uplift after the start. Which contacts slip is another story in either run: of 20 m
    // of extension single discs take some metres more or less, their mean some centimetres.
    EXPECT_NEAR(mean, 10.0, 0.1);
    EXPECT_GT(lifts[few], 5.0);
    EXPECT_LT(lifts[lifts.size() - 1 - few], 15.0);
    // The nodes are where they should be, to what a cycle's extension is uncertain.
    const ConstBaseNodeColumns nodes = base_node_columns(moved);
    ASSERT_GT(nodes.x.size(), 10u);
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        EXPECT_NEAR(nodes.uy[k], 10.0, 0.01);
        EXPECT_EQ(nodes.ux[k], 0.0);
    }
    EXPECT_EQ(rigid.base_nodes.rows(), 0u);
}

TEST_F(BaseMotionRun, EndsInTheSameBitsAfterAResumeAndWithTwoThreads) {
    std::ofstream(folder / "motion.csv") << "time_a,x_m,dx_m,dy_m\n0,0,0,0\n0,4000,0,0\n"
                                            "2000,0,2,-8\n2000,4000,1,6\n";
    const Scene s = load("[base_motion]\ncsv = \"motion.csv\"\n");
    const auto whole = run(s, "whole");
    run(s, "parts", 10.0);
    const auto parts = run(s, "parts", {}, true);
    EXPECT_EQ(parts["state_hash"], whole["state_hash"]);
    EXPECT_EQ(run(s, "threads", {}, false, 2)["state_hash"], whole["state_hash"]);
    EXPECT_THAT(whole["effects"], testing::Contains("base_motion"));
    // The scene that was written reads back without the file.
    fs::remove(folder / "motion.csv");
    SceneRequest request;
    request.scene = (folder / "whole/scene.toml").string();
    const Scene again = load_scene(request);
    EXPECT_EQ(again.find<BaseMotionParameters>()->uplift.size(), 2u);
    EXPECT_EQ(again.find<BaseMotionParameters>()->shift.size(), 2u);
}

TEST_F(BaseMotionRun, RefusesWhatMakesNoSense) {
    EXPECT_THAT(refusal("[base_motion]\n"), HasSubstr("needs csv, or uplift or shift"));
    EXPECT_THAT(refusal(std::string(even_uplift) + "[elastic_base]\n"),
                HasSubstr("base_motion: beside [elastic_base]"));
    EXPECT_THAT(refusal(even_uplift, {"extension.rate_m_per_a=0.0001"}),
                HasSubstr("moves 100 times as fast as extension, allowed: at most 5"));
    EXPECT_THAT(refusal("[base_motion]\ncsv = \"none.csv\"\n"), HasSubstr("no such file"));
    std::ofstream(folder / "bad.csv") << "time_a,x_m\n0,0\n";
    EXPECT_THAT(refusal("[base_motion]\ncsv = \"bad.csv\"\n"),
                HasSubstr("bad.csv:1: has no column uplift_m"));
}

TEST_F(BaseMotionRun, WarnsOfMotionThatMovesNothing) {
    const auto warnings = [&](const std::string& uplift) {
        return load("[base_motion]\nuplift = " + uplift + "\n").warnings;
    };
    const auto nothing = testing::Contains(HasSubstr("base_motion moves nothing up to the end"));
    EXPECT_THAT(warnings("[[0.0, 0.0], [4000.0, 10.0]]"), nothing);
    EXPECT_THAT(warnings("[{time_a = 5000.0, points = [[0.0, 0.0]]}, "
                         "{time_a = 9000.0, points = [[0.0, 10.0]]}]"), // the run ends at 2000 a
                nothing);
    EXPECT_THAT(warnings("[{time_a = 0.0, points = [[0.0, 0.1]]}, "
                         "{time_a = 9000.0, points = [[0.0, 0.1]]}]"),
                nothing);
    EXPECT_THAT(warnings("[{time_a = 0.0, points = [[0.0, 0.0]]}, "
                         "{time_a = 9000.0, points = [[0.0, 10.0]]}]"),
                testing::Not(nothing));
}

TEST(DetachmentNodes, FollowTheChain) {
    const Chain chain{arc({0.0, 0.0}, {0.0, -1.0}, 1500.0, 0.5 * std::numbers::pi),
                      line({1500.0, -1500.0}, {6000.0, -1500.0})};
    const std::vector<Point> nodes = detachment_nodes(chain, 1000.0);
    ASSERT_EQ(nodes.size() % 2, 1u); // start, middle, end of every face
    EXPECT_EQ(nodes.front(), chain.front().start);
    EXPECT_EQ(nodes.back(), chain.back().end);
    std::vector<double> x, y, still(nodes.size(), 0.0);
    for (const Point& p : nodes) {
        x.push_back(p.x);
        y.push_back(p.y);
    }
    const Trace trace(x, y, still, still, 2);
    for (int k = 1; k < 100; ++k) {
        const Point p = point_at(chain, 1500.0 * 0.5 * std::numbers::pi * k / 100);
        const auto foot = trace.nearest(p);
        ASSERT_TRUE(foot);
        EXPECT_LT(std::abs(foot->foot.distance), 2.0); // h^3 / (72 sqrt(3) R^2) and less
    }
}

} // namespace
} // namespace listric::base_motion_test
