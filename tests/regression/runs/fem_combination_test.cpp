// The elastic base with each of the choices of combination_test.cpp, taken and left: two runs cover
// these pairs, one with everything and one with what a base that bends cannot do without. A third
// has stages, which the account of energy refuses. Each must finish, stay finite, and keep mass and
// the balance of the interface.

#include "tests/scene_runs.hpp"
#include "tests/xml_files.hpp"

#include <gmock/gmock.h>

namespace listric::fem_combination_test {

using namespace dem;
namespace {

using namespace support;

class ElasticCombination : public SceneRuns {
protected:
    /// All effects but energy and stages.
    const std::vector<std::string> nearly_all{
        "lower_crust_thinning.thickness_m=20e3",
        "lower_crust_thinning.width_m=15e3",
        "footwall_erosion.interval_a=1000.0",
        "basin_water={}",
        R"(layer=[{name="salt", top_m=300.0, thickness_m=300.0, material="salt", weakens_to="none"}])",
        "old_fault=[{points=[[1500.0, 200.0], [2500.0, 1400.0]], band_width_diameters=2.0}]"};

    nlohmann::json run_on_elastic_base(SceneRequest request, RunOptions how) {
        request.scene = test_scene("every-effect.toml");
        for (const char* change :
             {"elastic_base.elastic_thickness_m=1000.0", "elastic_base.depth_m=3000.0",
              "elastic_base.left_m=-30e3", "elastic_base.right_m=35e3",
              "elastic_base.skin_thickness_m=300.0", "elastic_base.cell_size_m=150.0",
              "extension.distance_m=130", "extension.speed_m_per_s=1.0"})
            request.set.push_back(change);
        how.force = true;
        const nlohmann::json summary = run(load_scene(request), how);
        EXPECT_EQ(summary["finished"], true);
        EXPECT_LT(summary["mass_error_fraction"].get<double>(), 1e-13);
        EXPECT_LT(summary["interface_force_error"].get<double>(), 1e-12);
        EXPECT_LT(summary["interface_moment_error"].get<double>(), 1e-12);
        EXPECT_GT(summary["base_deflection_max_m"].get<double>(), 1.0);
        for (const auto& [name, value] : summary.items())
            EXPECT_FALSE(value.is_null()) << name;
        const Snapshot last = read_snapshot(list_snapshots(how.output).back());
        for (const Table* table : {&last.state.discs, &last.state.contacts,
                                   &last.state.base_contacts, &last.state.base_nodes})
            EXPECT_TRUE(all_finite(*table));
        return summary;
    }
};

TEST_F(ElasticCombination, WithEverything) {
    RunOptions how = options("all");
    how.threads = 3;
    SceneRequest request{
        .set = {"energy={}", "output.series=paraview", "output.figures_at_m=[100]"}, .seed = 2};
    request.set.insert(request.set.end(), nearly_all.begin(), nearly_all.end());
    const nlohmann::json summary = run_on_elastic_base(request, how);
    EXPECT_THAT(summary["effects"],
                testing::IsSupersetOf({"gravity", "bonds", "fault_weakening", "bond_healing",
                                       "sedimentation", "compaction", "energy", "elastic_base",
                                       "lower_crust_thinning", "basin_water", "footwall_erosion",
                                       "layer", "old_fault"}));
    EXPECT_TRUE(summary.contains("energy_residual"));
    EXPECT_THAT(xml_files(how.output), testing::StartsWith("2 of .pvd\n"));
}

TEST_F(ElasticCombination, WithStages) {
    SceneRequest request{.set = {"stage=[{distance_m=100.0}, {pause_a=1000.0}, {distance_m=-20.0, "
                                 "detachment_friction=0.1, sediment_friction=0.4}]",
                                 "detachment.footwall_top_m=2000.0"}};
    request.set.insert(request.set.end(), nearly_all.begin(), nearly_all.end());
    const nlohmann::json summary = run_on_elastic_base(request, options("stages"));
    EXPECT_THAT(summary["effects"], testing::IsSupersetOf({"stage", "layer", "old_fault"}));
    EXPECT_NEAR(summary["travel_m"].get<double>(), 130.0, 0.1);
}

TEST_F(ElasticCombination, WithNothingElse) {
    RunOptions how = options("alone");
    how.plain = true;
    const nlohmann::json summary = run_on_elastic_base(
        {.without = {"bonds", "fault_weakening", "bond_healing", "sedimentation", "compaction"}},
        how);
    EXPECT_THAT(summary["effects"], testing::UnorderedElementsAre("gravity", "elastic_base"));
}

} // namespace
} // namespace listric::fem_combination_test
