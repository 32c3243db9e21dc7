// Scenes at the ends of what a section can be, each with an answer that is known beforehand. None
// takes more than 5 s of a core.
//   60 km of extension: all rock leaves the head block's arc, so the cutoff is where a rigid block
//     that follows the detachment has it, and the basin has the area extension x thickness.
//   A basin deeper than the hanging wall is thick: its area is that and what the base sinks by.
//   A layer of one disc of the hanging wall's own rock changes nothing.
//   Kinks of up to 90 degrees: no disc is beyond the detachment, and all rock moves on.
//   Without gravity nothing presses the rock on its base, which slips away below it.

#include "apps/support/error.hpp"
#include "tests/message_of.hpp"
#include "tests/scene_runs.hpp"
#include "tests/stability/hard_case.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace listric::extreme_scene_test {

using namespace dem;
namespace {

using namespace support;
using testing::AllOf;
using testing::HasSubstr;

/// A hanging wall of a tenth of the paper's size, or of another one, on a quarter circle.
std::string halfgraben(double thickness, double mean_radius) {
    return fmt::format(R"([hanging_wall]
length_m = {0:g}
thickness_m = {1:g}
mean_radius_m = {2:g}
[detachment]
segments = [{{arc = {{radius_m = {1:g}, end_dip_deg = 0.0}}}}, {{line = {{length_m = {3:g}}}}}]
)",
                       8.0 / 3.0 * thickness, thickness, mean_radius, 8.0 * thickness);
}

std::string motion(double distance, double speed) {
    return fmt::format("[extension]\ndistance_m = {:g}\nspeed_m_per_s = {:g}\n"
                       "[output]\ninterval_m = {:g}\nfigures_at_m = []\nseries = \"none\"\n"
                       "report = false\n",
                       distance, speed, 0.25 * distance);
}

constexpr const char* rock = "[gravity]\n[bonds]\n[fault_weakening]\n[bond_healing]\n";
constexpr const char* fill = "[sedimentation]\n[compaction]\n";

class ExtremeScene : public SceneRuns {
protected:
    /// Checks what no run may lose: mass, numbers, rock, and that all discs are inside.
    /// @param sunk  by how much the whole base has sunk, m
    nlohmann::json run_whole(const Scene& scene, double sunk = 0.0) {
        const nlohmann::json summary = run(scene, options("run"));
        first = read_snapshot(list_snapshots(folder / "run").front()).state;
        last = read_snapshot(list_snapshots(folder / "run").back()).state;
        EXPECT_LT(std::abs(summary["mass_error_fraction"].get<double>()), 1e-12);
        EXPECT_TRUE(all_finite(last.discs));
        EXPECT_EQ(rock_discs(last), rock_discs(first));
        State lifted = last;
        for (double& y : disc_columns(lifted).y)
            y += sunk;
        EXPECT_EQ(escaped(lifted, make_parts(scene).base), 0);
        return summary;
    }

    static std::ptrdiff_t rock_discs(const State& state) {
        return std::ranges::count(disc_columns(state).stratum, 0);
    }

    /// Share of pairs of sediment discs above each other of which the younger is above.
    static double strata_in_order(const State& state) {
        const ConstDiscColumns d = disc_columns(state);
        double in_order = 0.0, pairs = 0.0;
        for (std::size_t i = 0; i < d.x.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (d.stratum[i] > 0 && d.stratum[j] > 0 && d.stratum[i] != d.stratum[j] &&
                    std::abs(d.x[i] - d.x[j]) < 0.5 * state.mean_radius) {
                    in_order += (d.stratum[i] > d.stratum[j]) == (d.y[i] > d.y[j]);
                    pairs += 1.0;
                }
        EXPECT_GT(pairs, 100.0);
        return in_order / pairs;
    }

    /// Why a scene is refused.
    std::string refusal(const std::string& text) const {
        return support::message_of<SceneError>([&] { load(text); }, "");
    }

    State first, last;
};

// At 12 m/s three packings of five were thrown about.
TEST_F(ExtremeScene, SixtyKilometresOfExtension) {
    const nlohmann::json summary =
        run_whole(load(halfgraben(15e3, 1000.0) + motion(60e3, 3.0) + rock + fill));
    // A block of rock ends within a disc.
    EXPECT_NEAR(summary["cutoff_x_m"].get<double>(), summary["predicted_cutoff_x_m"].get<double>(),
                2000.0);
    EXPECT_NEAR(summary["cutoff_z_m"].get<double>(), 15e3, 1000.0);
    EXPECT_NEAR(summary["area_balance"].get<double>(), 1.0, 0.05); // as at any extension: trust.md
    const ConstDiscColumns d = disc_columns(std::as_const(last));
    EXPECT_NEAR(std::ranges::max(d.x), 100e3, 2000.0); // the wall has taken it along
    EXPECT_GT(strata_in_order(last), 0.95);            // discs of 1 km are mixed where faults are
}

TEST_F(ExtremeScene, BasinDeeperThanTheHangingWall) {
    const auto sinking = [](double years) {
        return fmt::format("[base_motion]\nuplift = [{{time_a = 0.0, points = [[0.0, 0.0]]}}, "
                           "{{time_a = {:g}, points = [[0.0, -3500.0]]}}]\n",
                           years);
    };
    const std::string text = halfgraben(1500.0, 100.0) + motion(800.0, 0.6) + rock +
                             "[sedimentation]\ninterval_a = 1000.0\n[compaction]\n";
    const nlohmann::json summary = run_whole(load(text + sinking(80e3)), 3500.0);
    const double area = 800.0 * 1500.0 + 3500.0 * 4800.0;
    // The surface is level within a disc, 200 m of 3.7 km.
    EXPECT_NEAR(summary["basin_area_m2"].get<double>() / area, 1.0, 0.05);
    EXPECT_GT(summary["depocentres"].front()["thickness_m"].get<double>(), 2.0 * 1500.0);
    EXPECT_GT(strata_in_order(last), 0.99);
    // Sediment of all depths carries what lies above it; measured in circles of a few coarse discs.
    EXPECT_NEAR(summary["sediment_stress_ratio"].get<double>(), 1.0, 0.1);
    // A base that falls away from under its rock, which then falls after it, is refused.
    EXPECT_THAT(refusal(text + sinking(10e3)),
                AllOf(HasSubstr("small.toml:"), HasSubstr("base_motion"), HasSubstr("allowed"),
                      HasSubstr("spread it over more time")));
}

TEST_F(ExtremeScene, LayerOfOneDisc) {
    const std::string text = halfgraben(1500.0, 60.0) + motion(400.0, 1.0) + rock + fill;
    const auto layer = [&](const char* material) {
        return load(text + "[[layer]]\nname = \"thin\"\ntop_m = 600.0\nthickness_m = 120.0\n" +
                    fmt::format("material = \"{}\"\n", material));
    };
    run(load(text), options("none"));
    const State none = read_snapshot(list_snapshots(folder / "none").back()).state;
    run_whole(layer("mat18-b"));
    const auto of_layer = [](const State& state) {
        return std::ranges::count(state.discs.get<std::uint8_t>("layer"), 1);
    };
    // A strip of a packing with a porosity of 0.17; a disc more or less at the edges of each row.
    const double length = 4000.0 - (1500.0 - std::sqrt(1500.0 * 1500.0 - 660.0 * 660.0));
    const double expected = 0.83 * length * 120.0 / (pi * 60.0 * 60.0);
    EXPECT_NEAR(static_cast<double>(of_layer(first)), expected, 0.2 * expected);
    EXPECT_EQ(of_layer(last), of_layer(first));
    const ConstDiscColumns a = disc_columns(std::as_const(last)),
                           b = disc_columns(std::as_const(none));
    EXPECT_TRUE(std::ranges::equal(a.x, b.x) && std::ranges::equal(a.y, b.y));
    // A layer of other rock does change the run.
    RunOptions other = options("run");
    other.force = true;
    run(layer("mica"), other);
    const State mica = read_snapshot(list_snapshots(folder / "run").back()).state;
    EXPECT_EQ(of_layer(mica), of_layer(first));
    EXPECT_FALSE(std::ranges::equal(disc_columns(mica).x, b.x));
}

TEST_F(ExtremeScene, KinksOfUpToARightAngle) {
    const auto kinked = [](double dip) {
        return fmt::format(
                   "[hanging_wall]\nlength_m = 4000.0\nthickness_m = 1500.0\nmean_radius_m = 60.0\n"
                   "[detachment]\nstart_dip_deg = 90.0\nsegments = [{{line = {{length_m = "
                   "700.0}}}}, "
                   "{{line = {{length_m = 600.0, start_dip_deg = 0.0}}}}, "
                   "{{line = {{length_m = {:.6f}, start_dip_deg = {:g}}}}}, "
                   "{{line = {{length_m = 8000.0, start_dip_deg = 0.0}}}}]\n",
                   800.0 / std::sin(std::min(dip, 90.0) * pi / 180.0), dip) +
               motion(800.0, 1.0) + rock + fill;
    };
    for (const double dip : {85.0, 90.0}) {
        const Scene scene = load(kinked(dip));
        std::filesystem::remove_all(folder / "run");
        const nlohmann::json summary = run_whole(scene);
        const Chain& chain = make_parts(scene).base.surfaces.front().chain;
        const ConstDiscColumns d = disc_columns(std::as_const(last));
        // A soft, weakened disc under 1.5 km of rock, which a ridge concentrates, gives way by a
        // tenth.
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (const auto foot = nearest(chain, {d.x[i], d.y[i]})) {
                EXPECT_GT(foot->distance, 0.8 * d.radius[i]) << dip;
            }
        EXPECT_NEAR(std::ranges::max(d.x), 4800.0, 120.0) << dip;
        EXPECT_NEAR(summary["area_balance"].get<double>(), 1.0, 0.1) << dip;
    }
    EXPECT_THAT(refusal(kinked(100.0)), AllOf(HasSubstr("small.toml:"), HasSubstr("start_dip_deg"),
                                              HasSubstr("100"), HasSubstr("folds back")));
    std::ofstream(folder / "folded.csv")
        << "x_m,depth_m\n0,0\n500,700\n1200,700\n1100,1300\n1800,1500\n12000,1500\n";
    EXPECT_THAT(
        refusal("[hanging_wall]\nlength_m = 4000.0\nthickness_m = 1500.0\n[detachment]\ncsv = "
                "\"folded.csv\"\n[gravity]\n"),
        AllOf(HasSubstr("folded.csv:5"), HasSubstr("100 m"), HasSubstr("may not fold back")));
}

TEST_F(ExtremeScene, WithoutGravityTheBaseSlipsAway) {
    const nlohmann::json summary =
        run_whole(load(halfgraben(1500.0, 60.0) + motion(100.0, 1.0) + "[bonds]\n[energy]\n"));
    const ConstDiscColumns d = disc_columns(std::as_const(last));
    Point momentum;
    double mass = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        EXPECT_LT(std::hypot(d.x[i] - d.start_x[i], d.y[i] - d.start_y[i]), 1e-3 * d.radius[i]);
        momentum = {momentum.x + d.mass[i] * d.vx[i], momentum.y + d.mass[i] * d.vy[i]};
        mass += d.mass[i];
    }
    // Against rock that moved with the base, at 1 m/s.
    EXPECT_LT(std::hypot(momentum.x, momentum.y), 1e-3 * mass);
    EXPECT_LT(summary["energy_kinetic_j_per_m"].get<double>(), 1e-6 * 0.5 * mass);
    // All the work that the base does is lost by slip where a few discs still touch it.
    EXPECT_NEAR(summary["energy_friction_j_per_m"].get<double>() /
                    summary["energy_boundary_work_j_per_m"].get<double>(),
                1.0, 0.01);
    EXPECT_LT(std::abs(summary["energy_residual"].get<double>()), 1e-9);
    const ConstContactColumns c = contact_columns(std::as_const(last));
    EXPECT_GT(std::ranges::count(c.bonded, 1), 1.5 * static_cast<double>(d.x.size()));
}

TEST_F(ExtremeScene, RockUnderPressureFliesApartWithoutGravity) {
    const Scene scene =
        load(halfgraben(1500.0, 60.0) + motion(100.0, 1.0) + "[gravity]\n[bonds]\n");
    RunOptions o = options("run");
    o.until = 0.0;
    run(scene, o);
    State state = read_snapshot(list_snapshots(o.output).back()).state;
    advance(state, make_parts(scene).base, {0.7, 0.0}, 2000);
    EXPECT_GT(fastest(state), 0.05);
    const ConstContactColumns c = contact_columns(std::as_const(state));
    EXPECT_LT(std::ranges::count(c.bonded, 1), std::ssize(c.bonded) / 2);
}

} // namespace
} // namespace listric::extreme_scene_test
