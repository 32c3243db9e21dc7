// A cover above a fault of rigid basement, from the scene to the discs.

#include "dem/base/motion.hpp"
#include "dem/base/place.hpp"
#include "tests/message_of.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

namespace listric::basement_fault_test {

using namespace dem;
namespace {

using namespace support;
using testing::HasSubstr;

const std::string box = R"([hanging_wall]
length_m = 4000.0
thickness_m = 1000.0
mean_radius_m = 50.0
[extension]
speed_m_per_s = 1.0
ramp_s = 5.0
[output]
interval_m = 20.0
figures_at_m = []
series = "none"
report = false
[gravity]
)";

std::string fault(const std::string& sense, const std::string& dip,
                  const std::string& slip = "60.0") {
    return "[base_motion]\nfault_x_m = 2000.0\nfault_dip_deg = " + dip + "\nfault_sense = \"" +
           sense + "\"\n" + (slip.empty() ? "" : "fault_slip_m = " + slip + "\n");
}

constexpr const char* sand = "[materials]\nbasement = \"sandbox-sand\"\n";

class BasementFault : public SceneRuns {
protected:
    State last_state(const std::string& name) const {
        return read_snapshot(list_snapshots(folder / name).back()).state;
    }

    std::string refusal(const std::string& text) const {
        return message_of<SceneError>([&] { load(text); }, "");
    }

    /// Greatest overlap of a disc and the base line, over its radius.
    static double deepest(const Scene& scene, const State& state) {
        const RigidBase standing = standing_base(make_rigid_base(scene), state);
        const ConstDiscColumns d = disc_columns(state);
        double deepest = 0.0;
        for (std::size_t i = 0; i < d.x.size(); ++i)
            for (const Surface& surface : standing.surfaces)
                if (const auto foot = nearest(surface, state.clock.extension.m, {d.x[i], d.y[i]}))
                    deepest = std::max(deepest, 1.0 - foot->distance / d.radius[i]);
        return deepest;
    }

    static constexpr double left_of_fault = 250.0, right_of_fault = 3000.0; ///< m

    /// Mean displacement of the discs on the base that began within 250 m of a place, left or right
    /// of the fault. Beside the wall that leaves it the cover fails as a wedge.
    static Point moved(const State& state, bool right) {
        const ConstDiscColumns d = disc_columns(state);
        const double place = right ? right_of_fault : left_of_fault;
        Point sum;
        double count = 0.0;
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (d.start_y[i] < -850.0 && std::abs(d.start_x[i] - place) < 250.0) {
                sum = {sum.x + d.x[i] - d.start_x[i], sum.y + d.y[i] - d.start_y[i]};
                count += 1.0;
            }
        return {sum.x / count, sum.y / count};
    }
};

TEST_F(BasementFault, BlocksCarryWhatRestsOnThemAndNoDiscFallsThrough) {
    struct Case {
        std::string rock, sense;
        double dip;
    };
    std::vector<Case> cases{{"[bonds]\n", "normal", 60.0}, {"[bonds]\n", "reverse", 60.0}};
    for (const char* const sense : {"normal", "reverse"})
        for (const double dip : {30.0, 90.0})
            cases.push_back({sand, sense, dip});
    for (const auto& [rock, sense, dip] : cases) {
        SCOPED_TRACE(rock + sense + fmt::format(" {}", dip));
        const Scene scene = load(box + rock + fault(sense, fmt::format("{:.1f}", dip)));
        const auto summary = run(scene, "run");
        const State state = last_state("run");
        EXPECT_EQ(summary["finished"], true);
        EXPECT_NEAR(state.clock.extension.m, 60.0, 0.5);
        const double down = sense == "normal" ? 1.0 : -1.0, angle = dip * pi / 180.0;
        const Point left = moved(state, false), right = moved(state, true);
        // Rock goes with its block; at 1 m/s sand is left behind sideways.
        EXPECT_NEAR(left.x, 0.0, 4.0);
        EXPECT_NEAR(left.y, 0.0, 4.0);
        if (rock != sand) {
            EXPECT_NEAR(right.x, down * 60.0 * std::cos(angle), 1.0);
        }
        EXPECT_NEAR(right.y, -down * 60.0 * std::sin(angle), 4.0);
        // Contacts under a kilometre of rock overlap by up to 0.005 of a radius.
        EXPECT_LT(deepest(scene, state), 0.02);
    }
}

TEST_F(BasementFault, EndsInTheSameBitsAfterAResumeAndWithTwoThreads) {
    for (const char* const more : {"", "[stretching]\n"}) {
        // Alone, the slip is the run's way.
        const std::vector<std::string> set =
            *more ? std::vector<std::string>{"extension.distance_m=80.0"}
                  : std::vector<std::string>{};
        const Scene scene = load(box + sand + fault("reverse", "45.0") + more, set);
        const auto whole = run(scene, "whole");
        run(scene, "parts", 25.0);
        EXPECT_EQ(run(scene, "parts", {}, true)["state_hash"], whole["state_hash"]);
        EXPECT_EQ(run(scene, "threads", {}, false, 2)["state_hash"], whole["state_hash"]);
        // What the run wrote begins the same run again.
        SceneRequest request;
        request.scene = (folder / "whole/scene.toml").string();
        EXPECT_EQ(run(load_scene(request), "again")["state_hash"], whole["state_hash"]);
    }
}

TEST_F(BasementFault, BesideAStretchingBaseIsAPartOfTheWallsWay) {
    const Scene scene = load(box + sand + fault("normal", "60.0") + "[stretching]\n",
                             {"extension.distance_m=100.0", "extension.speed_m_per_s=0.25"});
    const RigidBase base = make_rigid_base(scene);
    EXPECT_DOUBLE_EQ(wall_way(base, 100.0), 100.0);
    const Chain line = base_line(base, 100.0); // 70 m of stretch: 35 of them left of the fault
    ASSERT_EQ(line.size(), 3u);
    EXPECT_NEAR(line[1].start.x, 2035.0, 1e-9);
    EXPECT_NEAR(line[1].end.x, 2065.0, 1e-9);
    EXPECT_NEAR(line[1].end.y, -1000.0 - 60.0 * std::sqrt(0.75), 1e-9);
    run(scene, "stretched");
    const State state = last_state("stretched");
    EXPECT_NEAR(moved(state, false).x, 70.0 * left_of_fault / 4000.0, 4.0);
    EXPECT_NEAR(moved(state, true).x, 30.0 + 70.0 * right_of_fault / 4000.0, 4.0);
    EXPECT_LT(deepest(scene, state), 0.02);
}

TEST_F(BasementFault, StagesLetItSlipBack) {
    const Scene scene = load(box + sand + fault("normal", "60.0", "") +
                             "[[stage]]\ndistance_m = 60.0\n[[stage]]\ndistance_m = -60.0\n");
    run(scene, "back");
    const State state = last_state("back");
    EXPECT_NEAR(state.clock.extension.m, 0.0, 0.5);
    EXPECT_NEAR(moved(state, true).y, 0.0, 4.0);
    EXPECT_LT(deepest(scene, state), 0.02);
}

TEST_F(BasementFault, UpliftNeedsNoDetachment) {
    constexpr const char* dome = "[base_motion]\nuplift = [{time_a = 0.0, points = [[0.0, 0.0]]}, "
                                 "{time_a = 6000.0, points = [[1000.0, 0.0], [2000.0, 60.0], "
                                 "[3000.0, 0.0]]}]\n";
    for (const char* const more : {"", "[stretching]\n"}) {
        const Scene scene = load(box + sand + dome + more, {"extension.distance_m=60.0"});
        run(scene, "dome");
        const State state = last_state("dome");
        const ConstDiscColumns d = disc_columns(state);
        double rise = 0.0, count = 0.0;
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (std::abs(d.start_x[i] - 2000.0) < 100.0) {
                rise += d.y[i] - d.start_y[i];
                ++count;
            }
        EXPECT_NEAR(rise / count, *more ? 37.0 : 52.0, 10.0); // less what stretching thins
        EXPECT_LT(deepest(scene, state), 0.02);
    }
}

TEST_F(BasementFault, RefusesWhatCannotBeCombined) {
    const std::string normal = fault("normal", "60.0");
    EXPECT_THAT(refusal(small_halfgraben() + "[gravity]\n" + normal),
                AllOf(HasSubstr("small.toml:"), HasSubstr("base_motion.fault_x_m: is 2000 beside "
                                                          "[detachment]; a fault of the basement "
                                                          "cuts a flat base")));
    EXPECT_THAT(refusal(box + normal + "uplift = [[0.0, 1.0]]\n"),
                HasSubstr("base_motion.fault_x_m: is 2000 beside uplift, shift or csv"));
    EXPECT_THAT(refusal(box + normal + "[elastic_base]\n"), HasSubstr("needs [detachment]"));
    EXPECT_THAT(refusal(box + normal + "[[stage]]\ndistance_m = 60.0\n"),
                HasSubstr("base_motion.fault_slip_m: is 60 beside [[stage]]"));
    EXPECT_THAT(refusal(box + fault("normal", "60.0", "") + "[stretching]\n"),
                HasSubstr("base_motion.fault_slip_m: is missing; beside [stretching]"));
    EXPECT_THAT(
        refusal(box + fault("normal", "60.0", "") + "[stretching]\n[[stage]]\ndistance_m = 60.0\n"),
        HasSubstr("is missing"));
    EXPECT_THAT(refusal(box + fault("normal", "60.0", "")),
                HasSubstr("base_motion.fault_slip_m: is missing; needs the slip at the end"));
    EXPECT_THAT(refusal(box + "[base_motion]\nfault_slip_m = 10.0\n"),
                HasSubstr("base_motion.fault_slip_m: is 10, but no fault slips; add fault_x_m"));
    EXPECT_THAT(refusal(box + normal + "friction = 0.2\n[stretching]\n"),
                HasSubstr("base_motion.friction: is 0.2 beside [stretching]"));
    EXPECT_THAT(refusal(box + fault("normal", "95.0")), HasSubstr("base_motion.fault_dip_deg"));
    EXPECT_THAT(refusal(box + fault("reverse", "30.0", "3000.0")),
                HasSubstr("the block on the right comes to x = -598"));
    EXPECT_THAT(refusal(box + "[base_motion]\nfault_x_m = 4000.0\nfault_slip_m = 10.0\n"),
                HasSubstr("base_motion.fault_x_m: is 4000, allowed: above 0 and below "
                          "hanging_wall.length_m = 4000"));
    EXPECT_THAT(
        message_of<SceneError>([&] { load(box + normal, {"extension.distance_m=70.0"}); }, ""),
        HasSubstr("extension.distance_m: is 70 beside base_motion.fault_slip_m = 60"));
}

TEST_F(BasementFault, SedimentAboveItHasPoreWater) {
    const Scene scene = load(box + sand + fault("normal", "60.0", "240.0") +
                                 "[sedimentation]\ninterval_a = 5000.0\n[compaction]\n"
                                 "[pore_fluid]\npermeability_m2 = 1e-21\n",
                             {"extension.speed_m_per_s=4.0"});
    const auto whole = run(scene, "whole");
    EXPECT_GT(whole["deposited_fraction"], 0.01);
    EXPECT_GT(whole["overpressure_ratio_mean"], 0.1);
    EXPECT_LT(std::abs(whole["water_error"].get<double>()), 1e-12);
    run(scene, "parts", 150.0);
    EXPECT_EQ(run(scene, "parts", {}, true)["state_hash"], whole["state_hash"]);
}

TEST_F(BasementFault, ShippedSceneBreaksTheSurface) {
    SceneRequest request;
    request.scene = "basement-fault";
    request.set = {"hanging_wall.mean_radius_m=160.0", "output.series=none",
                   "output.interval_m=100.0"};
    const auto summary = run(load_scene(request), "shipped");
    EXPECT_NEAR(summary["basement_fault_slip_m"], 600.0, 1.0);
    EXPECT_GT(summary["monocline_slope_deg"], 5.0);
    EXPECT_GT(summary["breakthrough_slip_m"], 20.0);
    EXPECT_LT(summary["breakthrough_slip_m"], 600.0);
    EXPECT_GT(summary["trishear_apical_angle_deg"], 5.0);
    EXPECT_LT(summary["trishear_misfit_m"], 100.0); // discs are 320 m wide
}

} // namespace
} // namespace listric::basement_fault_test
