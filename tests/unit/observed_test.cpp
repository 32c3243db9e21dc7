// Picked horizons: read, and compared with tops that are known.

#include "apps/archive/observed_misfit.hpp"
#include "apps/archive/setting.hpp"
#include "apps/measures/line_misfit.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/error.hpp"
#include "tests/support.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace listric {

using namespace dem;

namespace {

namespace fs = std::filesystem;
using measures::LineMisfit;
using measures::misfit;
using measures::Polyline;
using support::Disc;
using testing::HasSubstr;

TEST(LineMisfit, DistancesOfPointsBesideTheLine) {
    // Cut at a fault: the second piece lies 300 m lower.
    const std::vector<Polyline> pieces{{{0.0, 0.0}, {1000.0, 0.0}},
                                       {{1100.0, -300.0}, {2e3, -300.0}}};
    const std::vector<Point> picks{{500.0, 40.0}, {900.0, -20.0}, {1500.0, -360.0}, {5e3, 0.0}};
    const auto found = misfit(picks, pieces, 100.0);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->compared, 3u);
    EXPECT_NEAR(found->mean, 40.0, 1e-12);
    EXPECT_NEAR(found->largest, 60.0, 1e-12);
    EXPECT_EQ(found->worst, (Point{1500.0, -360.0}));
    EXPECT_FALSE(misfit(std::vector<Point>{{5e3, 0.0}}, pieces, 100.0));
    EXPECT_FALSE(misfit(picks, {}, 100.0));
}

class PicksFile : public testing::Test {
protected:
    fs::path folder = fs::path(testing::TempDir()) / fmt::format("listric-picks-{}", getpid());
    PicksFile() { fs::create_directories(folder); }
    ~PicksFile() override { fs::remove_all(folder); }

    Scene load(const std::string& table) const {
        std::ofstream(folder / "s.toml")
            << "accuracy = \"draft\"\n[hanging_wall]\n[detachment]\nsegments = [{arc = {radius_m = "
               "15000.0, end_dip_deg = 0.0}}]\n[gravity]\n[sedimentation]\n[observed]\n"
            << table;
        SceneRequest request;
        request.scene = (folder / "s.toml").string();
        return load_scene(request, program_effects());
    }
    std::string complaint_of(const std::string& text) const {
        std::ofstream(folder / "picks.csv") << text;
        try {
            load("horizons = \"picks.csv\"\n");
        } catch (const SceneError& error) {
            return error.what();
        }
        return "accepted";
    }
};

TEST_F(PicksFile, RowsOfOneNameAreALine) {
    std::ofstream(folder / "picks.csv") << "name,x_m,depth_m,age_a\ntop rift,0,100,1e6\n"
                                           "red,5,20,2e5\n top rift ,1000,150,1e6\n";
    std::ofstream(folder / "faults.csv") << "x_m,depth_m,name\n0,0,F1\n100,200,F1\n";
    const Scene scene = load("horizons = \"picks.csv\"\nfaults = \"faults.csv\"\n");
    ASSERT_TRUE(scene.observed);
    const auto& lines = scene.observed->horizons;
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0].name, "top rift");
    EXPECT_EQ(lines[0].age, 1e6);
    EXPECT_EQ(lines[0].x, (std::vector<double>{0.0, 1000.0}));
    EXPECT_EQ(lines[0].depth, (std::vector<double>{100.0, 150.0}));
    EXPECT_FALSE(scene.observed->faults.at(0).age);
    // What a run writes stands alone.
    std::ofstream(folder / "written.toml") << to_toml(scene);
    fs::remove(folder / "picks.csv");
    SceneRequest request;
    request.scene = (folder / "written.toml").string();
    EXPECT_EQ(to_toml(load_scene(request, program_effects())), to_toml(scene));
}

TEST_F(PicksFile, DamagedOnesAreRefusedWithLineAndCure) {
    EXPECT_THAT(complaint_of("x_m,depth_m\n0,0\n"), HasSubstr("has no column name"));
    EXPECT_THAT(complaint_of("name,x_m,depth_ft\na,0,0\n"), HasSubstr("1 ft = 0.3048 m"));
    EXPECT_THAT(complaint_of("name,x_m,depth_m\n,0,0\n"), HasSubstr("picks.csv:2: has no name"));
    EXPECT_THAT(complaint_of("name,x_m,depth_m\na,0,deep\n"),
                HasSubstr(":2: depth_m: \"deep\" is not a finite number"));
    EXPECT_THAT(complaint_of("name,x_m,depth_m\na,0,2e6\n"), HasSubstr("in metres?"));
    EXPECT_THAT(complaint_of("name,x_m,depth_m,age_a\na,0,0,-5\n"), HasSubstr("age_a: -5"));
    EXPECT_THAT(complaint_of("name,x_m,depth_m,age_a\na,0,0,1e5\na,1,0,2e5\n"),
                HasSubstr(":3: age_a: a has 100000 above and 200000 here"));
    EXPECT_THROW(load("horizons = \"none.csv\"\n"), SceneError);
}

/// Rock up to -1 km and two layers of sediment on it, 500 m each, deposited after 0.5 and 1 Ma.
TEST_F(PicksFile, AgesChooseTheTop) {
    std::ofstream(folder / "picks.csv")
        << "name,x_m,depth_m,age_a\nrift,3000,1030,1e6\nrift,9000,970,1e6\n"
           "middle,3000,600,5e5\nmiddle,9000,600,5e5\nold,3000,600,3e6\n"
           "far,90000,1000,1e6\n";
    Scene scene = load("horizons = \"picks.csv\"\n");
    const double r = 50.0;
    std::vector<Disc> discs = support::hexagonal(120, 60, r);
    for (Disc& disc : discs)
        disc.y -= 59.0 * std::sqrt(3.0) * r + r;
    State state = support::make_state(discs);
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < discs.size(); ++i) {
        d.stratum[i] = d.y[i] > -500.0 ? 2 : d.y[i] > -1000.0 ? 1 : 0;
        d.start_extension[i] = 5e3 * d.stratum[i];
        d.start_y[i] = d.y[i] + 1000.0; // the pre-rift top was the surface
    }
    state.clock.extension = 10e3;
    RigidBase base;
    base.surfaces = {{"detachment", {line({0.0, -1e4}, {1e5, -1e4})}, 0.0}};
    measures::Setting setting;
    setting.length = 12e3;
    setting.thickness = 1e4;
    setting.extension_rate = scene.extension.rate;
    const auto horizons = measures::trace_horizons(setting, base, state, {});
    const auto rows = archive::compare_horizons(scene, state, horizons);
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0].stratum, 0);
    EXPECT_NEAR(rows[0].misfit->mean, 30.0, r);
    EXPECT_EQ(rows[1].stratum, 1);
    EXPECT_NEAR(rows[1].misfit->mean, 100.0, r);
    EXPECT_THAT(rows[2].objection, HasSubstr("3e+06 a old"));
    EXPECT_THAT(rows[3].objection, HasSubstr("outside"));
    // Without ages the nearest top is taken.
    for (PickedLine& line : scene.observed->horizons)
        line.age.reset();
    EXPECT_EQ(archive::compare_horizons(scene, state, horizons)[1].stratum, 1);
}

} // namespace

} // namespace listric
