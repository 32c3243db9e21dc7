// A run with a soft layer, a bonded one and an old fault: equal bits by threads and cycle, and when
// it is resumed; the column `layer` is there only with the table. Some 370 discs to 100 m: ten
// seconds of processor time for the four runs.

#include "apps/archive/tables/exports.hpp"
#include "apps/figures/sections/seismic_section.hpp"
#include "apps/measures/strata/rock_layers.hpp"
#include "apps/model/model.hpp"
#include "apps/run/genesis_cache.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

namespace listric::layers_run_test {

using namespace dem;
namespace {

using namespace support;

class LayersRun : public SceneRuns {
protected:
    static Scene layered() {
        return load_scene(
            {.scene = test_scene("every-effect.toml"),
             .set = {"layer=[{name=\"mica\", material=\"mica\", top_m=300.0, thickness_m=300.0, "
                     "weakens_to=\"none\"}, {name=\"shale\", material=\"mat18-b\", top_m=600.0, "
                     "thickness_m=400.0, density_kg_per_m3=2400.0, welded=false}]",
                     "old_fault=[{points=[[2000.0, 300.0], [2400.0, 1200.0]]}]",
                     "extension.distance_m=100"}});
    }
};

TEST_F(LayersRun, HasEqualBitsHoweverItIsMade) {
    RunOptions o = options("one");
    o.threads = 1;
    const nlohmann::json one = run(layered(), o);
    EXPECT_EQ(one["finished"], true);
    o = options("three");
    o.threads = 3;
    EXPECT_EQ(run(layered(), o)["state_hash"], one["state_hash"]);
    o = options("plain");
    o.plain = true;
    EXPECT_EQ(run(layered(), o)["state_hash"], one["state_hash"]);
    o = options("parts");
    o.until = 50.0;
    run(layered(), o);
    o.until = {};
    o.resume = true;
    EXPECT_EQ(run(layered(), o)["state_hash"], one["state_hash"]);

    const Snapshot last = read_snapshot(list_snapshots(folder / "one").back());
    const State& state = last.state;
    ASSERT_EQ(state.materials.size(), 6u);
    EXPECT_TRUE(state.materials[3].is_soft);
    EXPECT_FALSE(state.materials[4].is_welded);
    EXPECT_EQ(state.materials[5].weak_of, 4);
    ASSERT_TRUE(state.materials[4].bonds);
    EXPECT_EQ(state.materials[4].bonds->tensile_mean, 2e4);
    const auto layer = state.discs.get<std::uint8_t>("layer");
    EXPECT_GT(std::ranges::count(layer, 1), 20);
    EXPECT_GT(std::ranges::count(layer, 2), 20);
    EXPECT_GT(std::ranges::count(disc_columns(state).material, 5), 0); // the old fault crosses it
    const auto shear = measures::bedding_shear(state);
    ASSERT_TRUE(shear);
    EXPECT_GT(shear->in_layers, 0.0);

    // The report's seismic image is of rock by its depth at the start, as the export's.
    const RunFolder left(folder / "one", layered());
    const Moment moment = left.read(left.snapshots.back());
    const Observation now{left.scene, left.parts, moment.state, moment.events};
    const auto image = [&](const std::vector<measures::Horizon>& horizons) {
        return seismic_section(now, {}, horizons, {.in_depth = true}).amplitude;
    };
    const std::vector<measures::Horizon> of_layers = horizons_of({now});
    EXPECT_EQ(image(seismic_horizons(now, of_layers)), image(seismic_horizons(now)));
    EXPECT_NE(image(of_layers), image(seismic_horizons(now)));
}

/// Weak rocks stand between those of layers: a kept hanging wall names its rocks by their places.
TEST_F(LayersRun, TakesNoHangingWallWhoseRocksHaveOtherPlaces) {
    const auto path = [](std::vector<std::string> without) {
        const Scene scene =
            load_scene({.scene = test_scene("every-effect.toml"),
                        .set = {"layer=[{name=\"upper\", material=\"mat18-b\", top_m=300.0, "
                                "thickness_m=300.0}, {name=\"lower\", material=\"mat18-b\", "
                                "top_m=600.0, thickness_m=400.0}]"},
                        .without = std::move(without)});
        return genesis_cache_path(scene, make_parts(scene));
    };
    EXPECT_NE(path({}), path({"fault_weakening"}));
    EXPECT_EQ(path({}), path({"bond_healing"}));
}

TEST_F(LayersRun, KeepsNoMemoryWithoutTheTable) {
    const Scene scene =
        load_scene({.scene = test_scene("every-effect.toml"), .set = {"extension.distance_m=10"}});
    run(scene, options("none"));
    const Snapshot last = read_snapshot(list_snapshots(folder / "none").back());
    EXPECT_FALSE(last.state.discs.has("layer"));
    EXPECT_EQ(last.state.materials.size(), 3u);
    EXPECT_FALSE(measures::bedding_shear(last.state));
}

} // namespace
} // namespace listric::layers_run_test
