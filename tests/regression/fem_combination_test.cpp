// The elastic base with each of the choices of combination_test.cpp, taken and left: two runs cover
// these pairs, one with everything and one with what a base that bends cannot do without. Each must
// finish, stay finite, and keep mass and the balance of the interface.

#include "tests/scene_runs.hpp"
#include "tests/xml_files.hpp"

#include <gmock/gmock.h>

namespace listric::fem_combination_test {

using namespace dem;
namespace {

using namespace support;

class ElasticCombination : public SceneRuns {
protected:
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
    const nlohmann::json summary = run_on_elastic_base(
        {.set = {"energy={}", "output.series=paraview", "output.figures_at_m=[100]",
                 "lower_crust_thinning.thickness_m=20e3", "lower_crust_thinning.width_m=15e3",
                 "footwall_erosion.interval_a=1000.0", "basin_water={}"},
         .seed = 2},
        how);
    EXPECT_THAT(summary["effects"],
                testing::IsSupersetOf({"gravity", "bonds", "fault_weakening", "bond_healing",
                                       "sedimentation", "compaction", "energy", "elastic_base",
                                       "lower_crust_thinning", "basin_water", "footwall_erosion"}));
    EXPECT_TRUE(summary.contains("energy_residual"));
    EXPECT_THAT(xml_files(how.output), testing::StartsWith("2 of .pvd\n"));
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
