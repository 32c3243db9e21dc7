// Picked horizons: read, and compared with tops that are known.

#include "apps/archive/folder/setting.hpp"
#include "apps/archive/tables/observed_misfit.hpp"
#include "apps/measures/strata/line_misfit.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/picks/picked_pieces.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/error.hpp"
#include "tests/message_of.hpp"
#include "tests/support.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace listric::observed_test {

using namespace dem;

namespace {

namespace fs = std::filesystem;
using measures::LineMisfit;
using measures::misfit;
using measures::Polyline;
using support::Disc;
using testing::AllOf;
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
        return support::message_of<SceneError>([&] { load("horizons = \"picks.csv\"\n"); });
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
    // The scene that a run writes stands alone.
    std::ofstream(folder / "written.toml") << to_toml(scene);
    fs::remove(folder / "picks.csv");
    SceneRequest request;
    request.scene = (folder / "written.toml").string();
    EXPECT_EQ(to_toml(load_scene(request, program_effects())), to_toml(scene));
}

TEST_F(PicksFile, PiecesOfOneNameAreOneHorizonOfOneAge) {
    std::ofstream(folder / "picks.csv") << "name,line,x_m,depth_m,age_a\nred,a,0,100,1e5\n"
                                           "red,a,500,120,\nred,b,900,300,\nblue,b,0,400,2e5\n"
                                           "red,b,1400,320,1e5\n";
    const Scene scene = load("horizons = \"picks.csv\"\n");
    const auto& pieces = scene.observed->horizons;
    ASSERT_EQ(pieces.size(), 3u);
    EXPECT_EQ(pieces[1].name, "red");
    EXPECT_EQ(pieces[1].age, 1e5); // that stands in rows of another piece
    EXPECT_EQ(pieces[1].x, (std::vector<double>{900.0, 1400.0}));
    const std::vector<PickedLine> whole = by_name(pieces);
    ASSERT_EQ(whole.size(), 2u);
    EXPECT_EQ(whole[0].x, (std::vector<double>{0.0, 500.0, 900.0, 1400.0}));
    EXPECT_EQ(whole[0].depth, (std::vector<double>{100.0, 120.0, 300.0, 320.0}));
    EXPECT_THAT(complaint_of("name,line,x_m,depth_m,age_a\na,0,0,0,1e5\na,1,1,0,2e5\n"),
                HasSubstr(":3: age_a: a has 100000 above and 200000 here"));
}

TEST_F(PicksFile, DamagedOnesAreRefusedWithLineAndCure) {
    EXPECT_THAT(complaint_of("x_m,depth_m\n0,0\n"), HasSubstr("has no column name"));
    EXPECT_THAT(complaint_of("name,x_m,depth_ft\na,0,0\n"), HasSubstr("1 ft = 0.3048 m"));
    EXPECT_THAT(complaint_of("name,x_m,depth_m\n,0,0\n"), HasSubstr("picks.csv:2: has no name"));
    EXPECT_THAT(complaint_of("name,x_m,depth_m\na,0,deep\n"),
                HasSubstr(":2: depth_m: \"deep\" is not a finite number"));
    EXPECT_THAT(complaint_of("name,x_m,depth_m\na,0,2e6\n"), HasSubstr("in metres?"));
    EXPECT_THAT(complaint_of("name,x_m,depth_m,age_a\na,0,0,-5\n"), HasSubstr("age_a: -5"));
    EXPECT_THAT(complaint_of("name,x_m,depth_m,age_ma\na,0,0,1\n"),
                AllOf(HasSubstr("picks.csv:1: has no column age_a"), HasSubstr("1 Ma = 1e6 a")));
    EXPECT_THAT(complaint_of("name,x_m,depth_m,Age\na,0,0,1\n"), HasSubstr("call Age age_a"));
    EXPECT_THAT(complaint_of("name,x_m,depth_m,Age_a\na,0,0,1\n"), HasSubstr("did you mean age_a"));
    EXPECT_EQ(complaint_of("name,x_m,depth_m,age_error,average\na,0,0,1,1\n"), "accepted");
    EXPECT_THAT(complaint_of(""), HasSubstr("has no header"));
    EXPECT_THAT(complaint_of("name,x_m,depth_m,age_a\na,0,0,1e5\na,1,0,2e5\n"),
                HasSubstr(":3: age_a: a has 100000 above and 200000 here"));
    EXPECT_THROW(load("horizons = \"none.csv\"\n"), SceneError);
    const auto refusal = [&](const std::string& table) -> std::string {
        return support::message_of<SceneError>([&] { load(table); });
    };
    EXPECT_THAT(refusal("horizons = \".\"\n"), HasSubstr("is a directory"));
    EXPECT_THAT(refusal("horizons = \"\"\n"), HasSubstr("observed.horizons: is empty"));
}

/// A scene of 12 km by 3 km on a picked fault, and what is said of its picks.
class SectionPicks : public PicksFile {
protected:
    static std::string fault(double shift) {
        std::string text = "x_m,depth_m\n";
        for (int k = 0; k <= 40; ++k) {
            const double dip = (60.0 - 1.5 * k) * pi / 180.0;
            text += fmt::format("{:.2f},{:.2f}\n",
                                shift + 6000.0 * (std::sin(pi / 3.0) - std::sin(dip)),
                                6000.0 * (std::cos(dip) - 0.5));
        }
        return text + fmt::format("{},3000\n", shift + 15'000.0);
    }
    /// 40 picks of a horizon of 1 km and down, by factors.
    static std::string picks(double shift, double across, double down) {
        std::string text = "name,x_m,depth_m\n";
        for (int k = 0; k < 40; ++k)
            text += fmt::format("Trias,{:.5f},{:.5f}\n", shift + across * (500.5 + 250.0 * k),
                                down * (1012.75 + 3.25 * k));
        return text;
    }
    Scene load_section(const std::string& detachment, const std::string& table) const {
        std::ofstream(folder / "s.toml")
            << "accuracy = \"draft\"\n[hanging_wall]\nlength_m = 12000.0\n[detachment]\ncsv = "
               "\"fault.csv\"\n"
            << detachment << "[extension]\ndistance_m = 600.0\n[gravity]\n[observed]\n"
            << table;
        return load_scene({.scene = (folder / "s.toml").string()}, program_effects());
    }
    std::string said_of(const std::string& text, const std::string& detachment = "",
                        const std::string& table = "horizons = \"picks.csv\"\n") const {
        std::ofstream(folder / "picks.csv") << text;
        try {
            const Scene scene = load_section(detachment, table);
            return scene.warnings.empty() ? "correct" : "warning: " + scene.warnings.front();
        } catch (const SceneError& error) {
            return error.what();
        }
    }
    SectionPicks() { std::ofstream(folder / "fault.csv") << fault(0.0); }
};

TEST_F(SectionPicks, ElevationsAreRefusedAndFewAboveTheSurfaceTold) {
    EXPECT_EQ(said_of(picks(0.0, 1.0, 1.0)), "correct");
    EXPECT_THAT(said_of(picks(0.0, 1.0, -1.0)),
                HasSubstr("picks.csv:2: depth_m: -1012.75 is above the original surface, as 40 of "
                          "40 picks; depth is positive down"));
    EXPECT_THAT(said_of("name,x_m,depth_m\na,500,1000\na,900,-800\n"),
                AllOf(HasSubstr("warning: "), HasSubstr("picks.csv:3: depth_m: -800 is above")));
    EXPECT_EQ(said_of("name,x_m,depth_m\na,500,10\na,900,-20\n"), "correct");
    EXPECT_THAT(said_of(picks(0.0, 1.0, -1.0), "", "faults = \"picks.csv\"\n"),
                HasSubstr("is above the original surface"));
}

TEST_F(SectionPicks, KilometresAreRefused) {
    for (const double sign : {1.0, -1.0})
        EXPECT_THAT(said_of(picks(0.0, 1e-3, sign * 1e-3)),
                    AllOf(HasSubstr("picks.csv:2: picks reach x_m = 10.25"),
                          HasSubstr("the model 12000 m and 3000 m; are they in metres?")));
    EXPECT_THAT(said_of(picks(0.0, 1.0, 1e-3)),
                AllOf(HasSubstr("warning: "), HasSubstr("are they in metres?")));
    EXPECT_THAT(said_of(picks(0.0, 100.0, 100.0)), HasSubstr("in metres?")); // centimetres
}

TEST_F(SectionPicks, AreShiftedAsTheFault) {
    const double east = 5412345.67;
    std::ofstream(folder / "fault.csv") << fault(east);
    std::ofstream(folder / "picks.csv") << picks(east, 1.0, 1.0);
    const std::string shift = "shift_x_m = -5412345.67\n", table = "horizons = \"picks.csv\"\n";
    const Scene scene = load_section(shift, table);
    EXPECT_NEAR(scene.observed->horizons[0].x[0], 500.5, 1e-6);
    EXPECT_TRUE(scene.warnings.empty());
    // With a shift of their own, and without any.
    std::ofstream(folder / "fault.csv") << fault(0.0);
    EXPECT_NEAR(load_section("", table + shift).observed->horizons[0].x[0], 500.5, 1e-6);
    EXPECT_THAT(said_of(picks(east, 1.0, 1.0)),
                AllOf(HasSubstr("picks.csv:2: all 40 picks lie beyond the model: they reach from "
                                "x_m = 5412846.2 to 5422596.2 and depth_m = 1012.75 to 1139.5"),
                      HasSubstr("give observed.shift_x_m")));
    std::ofstream(folder / "fault.csv") << fault(east);
    EXPECT_THAT(said_of(picks(0.0, 1.0, 1.0), shift),
                AllOf(HasSubstr("all 40 picks lie beyond"), HasSubstr("observed.shift_x_m = 0.0")));
    EXPECT_EQ(said_of(picks(0.0, 1.0, 1.0), shift, table + "shift_x_m = 0.0\n"), "correct");
}

TEST_F(SectionPicks, AsSpreadsheetsWriteThem) {
    std::string text = picks(0.0, 1.0, 1.0);
    std::ranges::replace(text, ',', ';');
    EXPECT_EQ(said_of(text), "correct");
    EXPECT_THAT(said_of("name,x_m,depth_m\nTrias,\"500,50\",\"1012,75\"\n"),
                HasSubstr("picks.csv:2: x_m: \"500,50\" is not a finite number: a decimal comma"));
    // Dated where the age is known.
    EXPECT_EQ(said_of("name,x_m,depth_m,age_a\nTrias,500,1000,\nSyn,500,100,3e4\nSyn,900,100,\n"),
              "correct");
    const Scene scene = load_section("", "horizons = \"picks.csv\"\n");
    EXPECT_FALSE(scene.observed->horizons[0].age);
    EXPECT_EQ(scene.observed->horizons[1].age, 3e4);
}

TEST_F(SectionPicks, AgesInAnotherUnitOrBeyondTheRiftAreTold) { // which lasts 60,000 a
    const std::string head = "name,x_m,depth_m,age_a\n";
    EXPECT_THAT(said_of(head + "a,500,1000,0.06\nb,500,100,0.03\n"),
                AllOf(HasSubstr("warning: "), HasSubstr("picks.csv:2: age_a: no age is above 0.06"),
                      HasSubstr("is it in years")));
    EXPECT_THAT(said_of(head + "a,500,1000,60000\nb,500,100,70000\n"),
                HasSubstr("picks.csv:3: age_a: 70000 is before the start of extension"));
    EXPECT_EQ(said_of(head + "a,500,1000,60000\nb,500,100,0\n"), "correct");
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
        d.start_travel[i] = 5e3 * d.stratum[i];
        d.start_y[i] = d.y[i] + 1000.0; // the pre-rift top was the surface
    }
    state.clock.travel.m = state.clock.extension.m = 10e3;
    RigidBase base;
    base.surfaces = {{"detachment", {line({0.0, -1e4}, {1e5, -1e4})}, 0.0}};
    measures::Setting setting;
    setting.length = 12e3;
    setting.thickness = 1e4;
    setting.calendar = scene.extension.rate;
    const auto horizons = measures::trace_horizons(setting, base, state, {});
    const auto rows = archive::compare_horizons(scene, state, horizons);
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0].stratum, 0);
    EXPECT_NEAR(rows[0].misfit->mean, 30.0, r);
    EXPECT_EQ(rows[1].stratum, 1);
    EXPECT_NEAR(rows[1].misfit->mean, 100.0, r);
    EXPECT_THAT(rows[2].objection, HasSubstr("3e+06 a old"));
    EXPECT_THAT(rows[3].objection, HasSubstr("outside"));
    // A run may end a time step short of the last pick, and a division miss the first.
    scene.observed->horizons[0].age = std::nextafter(1e6, 2e6);
    scene.observed->horizons[1].age = 0.0;
    state.clock.time_step = 0.01;
    state.clock.travel.m = 10e3 - 0.009 * scene.extension.speed;
    const auto at_ends = archive::compare_horizons(scene, state, horizons);
    EXPECT_EQ(at_ends[0].stratum, 0) << at_ends[0].objection;
    EXPECT_EQ(at_ends[1].stratum, 2) << at_ends[1].objection;
    // Without ages the nearest top is taken.
    state.clock.travel.m = 10e3;
    for (PickedLine& line : scene.observed->horizons)
        line.age.reset();
    EXPECT_EQ(archive::compare_horizons(scene, state, horizons)[1].stratum, 1);
}

} // namespace

} // namespace listric::observed_test
