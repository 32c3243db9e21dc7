// Target lines: heights, distances and change with time are exact but for round-off; the files they
// come from are refused with line, column and cure.

#include "apps/model/effects.hpp"
#include "apps/scene/picks/target_csv.hpp"
#include "apps/scene/scene.hpp"
#include "dem/base/target_line.hpp"
#include "dem/events/sedimentation.hpp"
#include "tests/message_of.hpp"
#include "tests/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace listric::target_line_test {

using namespace dem;
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(TargetLine, HeightIsLinearBetweenPointsAndLevelBeyond) {
    const TargetLine line({{0.0, 100.0}, {1000.0, -100.0}, {3000.0, 0.0}});
    EXPECT_EQ(line.height(-50.0), 100.0);
    EXPECT_EQ(line.height(0.0), 100.0);
    EXPECT_DOUBLE_EQ(line.height(250.0), 50.0);
    EXPECT_DOUBLE_EQ(line.height(2000.0), -50.0);
    EXPECT_EQ(line.height(3000.0), 0.0);
    EXPECT_EQ(line.height(9e4), 0.0);
    EXPECT_EQ(TargetLine({{5.0, -7.0}}).height(-1e5), -7.0);
}

TEST(TargetLine, DistanceIsToTheNearestPointOfTheLine) {
    const TargetLine level({{0.0, -7.0}});
    EXPECT_EQ(level.above({1e4, 3.0}), 10.0);
    EXPECT_EQ(level.above({-1e4, -9.0}), -2.0);
    const TargetLine line({{0.0, 0.0}, {300.0, 400.0}, {600.0, 0.0}});
    EXPECT_NEAR(line.above({150.0 - 80.0, 200.0 + 60.0}), 100.0, 1e-12);  // normal to the slope
    EXPECT_NEAR(line.above({150.0 + 80.0, 200.0 - 60.0}), -100.0, 1e-12); // and below it
    EXPECT_NEAR(line.above({300.0, 450.0}), 50.0, 1e-12);                 // over the crest
    EXPECT_NEAR(line.above({-400.0, -30.0}), -30.0, 1e-12);
    // Against every piece, at random places.
    const TargetLine wavy({{0.0, 0.0}, {10.0, 50.0}, {200.0, 20.0}, {210.0, -80.0}, {500.0, 0.0}});
    support::Random random(2);
    for (int k = 0; k < 100; ++k) {
        const Point p{random.between(-100.0, 600.0), random.between(-200.0, 200.0)};
        double least = 1e300;
        for (double x = p.x - 250.0; x < p.x + 250.0; x += 0.05)
            least = std::min(least, std::hypot(p.x - x, p.y - wavy.height(x)));
        EXPECT_NEAR(std::abs(wavy.above(p)), least, 0.3) << p.x << " " << p.y; // of the sampling
        EXPECT_EQ(wavy.above(p) > 0.0, p.y > wavy.height(p.x));
    }
}

TEST(Target, ChangesLinearlyBetweenStages) {
    const Target target(99.0, {{1000.0, {{0.0, 0.0}, {100.0, 10.0}}}, {3000.0, {{50.0, 40.0}}}});
    EXPECT_EQ(target.at(0.0).height(100.0), 10.0);
    EXPECT_DOUBLE_EQ(target.at(2000.0).height(0.0), 20.0);
    EXPECT_DOUBLE_EQ(target.at(2000.0).height(50.0), 22.5);
    EXPECT_DOUBLE_EQ(target.at(1500.0).height(100.0), 0.75 * 10.0 + 0.25 * 40.0);
    EXPECT_EQ(target.at(1e6).height(0.0), 40.0);
    EXPECT_EQ(Target(99.0).at(5.0).height(3.0), 99.0);
}

class TargetFileTest : public testing::Test {
protected:
    TargetFileTest() { fs::create_directories(folder); }
    ~TargetFileTest() override { fs::remove_all(folder); }

    std::string write(const std::string& text, const std::string& name) const {
        std::ofstream(folder / name, std::ios::binary) << text;
        return (folder / name).string();
    }
    template <class Call> std::string error_of(Call&& call) const {
        return support::scene_message_of(call, folder);
    }
    std::string error(const std::string& csv) const {
        return error_of([&] { read_target_csv(write(csv, "line.csv")); });
    }
    Scene load(const std::string& sedimentation, const std::vector<std::string>& set = {}) const {
        return load_scene({.scene = write("[hanging_wall]\n[detachment]\n"
                                          "segments = [{arc = {radius_m = 15e3}}]\n"
                                          "[sedimentation]\n" +
                                              sedimentation,
                                          "scene.toml"),
                           .set = set});
    }
    std::string scene_error(const std::string& text,
                            const std::vector<std::string>& set = {}) const {
        return error_of([&] { load(text, set); });
    }

    const fs::path folder =
        fs::temp_directory_path() / (std::string("listric_target_test_") +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(TargetFileTest, ReadsColumnsByTheirNames) {
    const auto stages = read_target_csv(write("\xef\xbb\xbfy_m, note ,x_m,time_a\r\n"
                                              "# base level\r\n"
                                              "-1e2,a,0,0\r\n\r\n"
                                              "0.5,b,1000,0\r\n"
                                              "7,c,-3,25000.5\r\n",
                                              "line.csv"));
    ASSERT_EQ(stages.size(), 2u);
    ASSERT_EQ(stages[0].points.size(), 2u);
    EXPECT_EQ(stages[0].time, 0.0);
    EXPECT_EQ(stages[0].points[0].y, -100.0);
    EXPECT_EQ(stages[0].points[1].x, 1000.0);
    EXPECT_EQ(stages[1].time, 25000.5);
    EXPECT_EQ(stages[1].points[0].x, -3.0);
}

TEST_F(TargetFileTest, BadFilesAreRefusedWithTheirLine) {
    const std::string header = "time_a,x_m,y_m\n";
    EXPECT_EQ(error(""), "line.csv: has no header, needs time_a, x_m, y_m");
    EXPECT_EQ(error(header), "line.csv: has no rows, needs time_a, x_m, y_m");
    EXPECT_EQ(error("time_a,x_m,z_m\n0,0,0\n"),
              "line.csv:1: has no column y_m, needs a header with time_a, x_m, y_m; it has time_a, "
              "x_m, z_m; if z_m is what is meant, call it y_m, in metres and positive up");
    EXPECT_EQ(error(header + "0,0,nan\n"),
              "line.csv:2: y_m: \"nan\" is not a finite number: no value; leave out what has none");
    EXPECT_EQ(error(header + "0,inf,0\n"),
              "line.csv:2: x_m: \"inf\" is not a finite number: infinity");
    EXPECT_EQ(error(header + "0,1;5,0\n"), "line.csv:2: x_m: \"1;5\" is not a finite number");
    EXPECT_EQ(error(header + "0,0,0\n0,5\n"),
              "line.csv:3: y_m: \"\" is not a finite number: empty");
    EXPECT_EQ(error(header + "0,0,0\n0,0,5\n"),
              "line.csv:3: x_m: 0 comes after 0 at the same time; sort the rows of one time by x, "
              "each x once");
    EXPECT_EQ(
        error(header + "50,0,0\n0,0,5\n"),
        "line.csv:3: time_a: 0 comes after 50; sort the rows by time, those of one time by x");
    EXPECT_EQ(error(header + "-1,0,0\n"),
              "line.csv:2: time_a: -1 is before the start of extension, "
              "allowed: at least 0");
    EXPECT_EQ(error(header + "0,0,2e5\n"),
              "line.csv:2: y_m: 200000 is out of range, allowed: at least -1e5, at most 1e5");
    // As a spreadsheet writes it where decimals have commas.
    EXPECT_THAT(error("\"time_a\",\"x_m\",\"y_m\"\n\"0\",\"0\",\"-100,5\"\n"),
                StartsWith("line.csv:2: y_m: \"-100,5\" is not a finite number: a decimal comma"));
    EXPECT_THAT(error(header + "0,5e9,1\n"), StartsWith("line.csv:2: x_m: 5e9 is out of range"));
    EXPECT_EQ(read_target_csv(write("time_a;x_m;y_m\n0;0;-100.5\n", "line.csv"))[0].points[0].y,
              -100.5);
    EXPECT_EQ(error_of([&] { read_target_csv(folder / "none.csv"); }),
              "none.csv: cannot be read: No such file or directory");
}

TEST_F(TargetFileTest, LinesBesideTheModelAreRefusedAndOddOnesAreTold) {
    const auto file = [&](const std::string& rows) {
        write("time_a,x_m,y_m\n" + rows, "line.csv");
        return std::string("target_csv = 'line.csv'\n");
    };
    const auto warnings = [&](const std::string& rows) { return load(file(rows)).warnings; };
    EXPECT_THAT(scene_error(file("0,5412345,0\n0,5422345,-200\n")),
                HasSubstr("line.csv: x_m reaches from 5412345 to 5422345, the model from 0 to"));
    EXPECT_THAT(warnings("0,0,0\n0,12,-200\n"), ElementsAre(HasSubstr("is it in metres?")));
    EXPECT_THAT(warnings("0,0,0\n0.5,0,-200\n"), ElementsAre(HasSubstr("is it in years")));
    EXPECT_THAT(warnings("0,0,0\n0,40000,-200\n5e5,0,-200\n"), IsEmpty());
}

TEST_F(TargetFileTest, MotionOfTheBaseIsReadLikeTargets) {
    const auto said = [&](const std::string& text) {
        write(text, "motion.csv");
        return error_of([&] {
            load_scene({.scene = write("[hanging_wall]\n[detachment]\nsegments = [{arc = {radius_m "
                                       "= 15e3}}]\n[base_motion]\ncsv = 'motion.csv'\n",
                                       "scene.toml")});
        });
    };
    EXPECT_EQ(said("time_a;x_m;uplift_m\n0;0;0\n0;40000;0\n1e6;0;+100\n1e6;40000;1D2\n"),
              "no error");
    EXPECT_THAT(said("time_a,x_m,uplift_m\n0,0,\"0,5\"\n"), HasSubstr("a decimal comma"));
    EXPECT_THAT(said("time_a,x_m,uplift_m,dx_m,dy_m\n0,0,0,0,0\n"),
                HasSubstr("uplift_m beside dx_m or dy_m"));
    EXPECT_THAT(said("time_a,x_m,dx_m\n0,0,0\n"), HasSubstr("has no column dy_m"));
    EXPECT_THAT(said("time_a,x_m,uplift_m\n0,5e5,0\n0,6e5,0\n1e6,5e5,1\n"),
                HasSubstr("give x from the breakaway on"));
}

TEST_F(TargetFileTest, ScenesGiveLinesOrFiles) {
    EXPECT_TRUE(load("").find<SedimentationParameters>()->target.empty());
    const Scene line = load("target = [[0, 0], [40000, -500]]\n");
    ASSERT_EQ(line.find<SedimentationParameters>()->target.size(), 1u);
    EXPECT_EQ(line.find<SedimentationParameters>()->target[0].points[1].y, -500.0);
    const Scene stages = load("target = [{time_a = 0, points = [[0, 0]]},\n"
                              "          {time_a = 1e6, points = [[0, -100.5], [5, 3]]}]\n");
    ASSERT_EQ(stages.find<SedimentationParameters>()->target.size(), 2u);
    EXPECT_EQ(stages.find<SedimentationParameters>()->target[1].points[0].y, -100.5);
    // A file is found beside the scene, and what a run writes stands alone.
    const std::string csv = write("time_a,x_m,y_m\n0,0,0.1\n5e5,0,-200\n5e5,9,3\n", "line.csv");
    const Scene from_file = load("target_csv = 'line.csv'\n");
    EXPECT_EQ(from_file.find<SedimentationParameters>()->target[1].points[1].x, 9.0);
    EXPECT_EQ(to_toml(load("", {"sedimentation.target_csv=" + csv})), to_toml(from_file));
    fs::remove(folder / "line.csv");
    for (const Scene& scene : {line, stages, from_file})
        EXPECT_EQ(to_toml(load_scene({.scene = write(to_toml(scene), "scene.toml")})),
                  to_toml(scene));
    EXPECT_THAT(to_toml(from_file),
                HasSubstr("{time_a = 500000.0, points = [[0.0, -200.0], [9.0, 3.0]]},\n"));
}

TEST_F(TargetFileTest, BadLinesOfScenesAreRefused) {
    EXPECT_EQ(scene_error("target = []\n"),
              "scene.toml:5: sedimentation.target: has no points, needs at least one, for example "
              "[[0.0, 0.0], [40000.0, -500.0]]");
    EXPECT_EQ(scene_error("target = [[0, 0], [5]]\n"),
              "scene.toml:5: sedimentation.target[1]: needs two numbers, for example "
              "[12000.0, -350.0]");
    EXPECT_EQ(scene_error("target = [[0, 0], [5, 'a']]\n"),
              "scene.toml:5: sedimentation.target[1][1]: wrong type (string \"a\"), allowed: array "
              "of points [x, y], or of {time_a = ..., points = [[x, y], ...]}");
    EXPECT_EQ(scene_error("target = [[0, 0], [5, nan]]\n"),
              "scene.toml:5: sedimentation.target[1][1]: out of range (nan), allowed: at least "
              "-100000, at most 100000");
    EXPECT_EQ(scene_error("target = [[7, 0], [5, 0]]\n"),
              "scene.toml:5: sedimentation.target[1]: is not sorted: x = 5 comes after 7; sort the "
              "points by x, each x once");
    EXPECT_EQ(
        scene_error("target = [{time_a = 5, points = [[0, 0]]}, {time_a = 5, points = [[0, "
                    "0]]}]\n"),
        "scene.toml:5: sedimentation.target[1]: is not sorted: time_a = 5 comes after 5; sort "
        "the stages by time, each time once");
    EXPECT_THAT(scene_error("target = [{time = 5}]\n"),
                StartsWith("scene.toml:5: sedimentation.target[0]: needs time_a and points"));
    EXPECT_EQ(scene_error("target_csv = 'none.csv'\n"),
              "scene.toml:5: sedimentation.target_csv: none.csv: no such file");
    write("time_a,x_m\n", "line.csv");
    EXPECT_THAT(scene_error("target_csv = 'line.csv'\n"),
                StartsWith("line.csv:1: has no column y_m"));
    EXPECT_EQ(
        scene_error("target_csv = 'line.csv'\ntarget = [[0, 0]]\n"),
        "scene.toml:5: sedimentation.target_csv: beside sedimentation.target; give one of them");
}

} // namespace
} // namespace listric::target_line_test
