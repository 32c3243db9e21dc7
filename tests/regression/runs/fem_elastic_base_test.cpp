// Scenes with an elastic base: what loads it besides discs, and what bad input leads to.

#include "apps/commands/explain.hpp"
#include "apps/model/base_driver.hpp"
#include "apps/model/effects/elastic_base_parameters.hpp"
#include "apps/model/effects/elastic_base_request.hpp"
#include "apps/model/model.hpp"
#include "apps/support/error.hpp"
#include "coupling/base_memory.hpp"
#include "coupling/elastic_base.hpp"
#include "coupling/interface_loads.hpp"
#include "coupling/lower_crust_thinning.hpp"
#include "fem/blocks.hpp"
#include "tests/places.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <sys/wait.h>

namespace listric::fem_elastic_base_test {

using namespace dem;
using namespace coupling;
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace support;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// 400 discs on a crust of 5 km, so slow that the base keeps up with its load (it takes 75 s to
/// follow); loads so large that they show in 60 m of extension.
const std::string scene = small_halfgraben() + R"([extension]
distance_m = 60.0
speed_m_per_s = 0.1
[output]
interval_m = 20.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
)" + small_elastic_base() +
                          "elastic_thickness_m = 1000.0\n";
const std::string loads = R"([lower_crust_thinning]
thickness_m = 20000.0
width_m = 15000.0
centre_m = 1500.0
[footwall_erosion]
interval_a = 1000.0
width_m = 20000.0
)";

class ElasticBaseRun : public SceneRuns {
protected:
    Scene load(const std::string& more = "", const std::vector<std::string>& set = {}) const {
        return SceneRuns::load(scene + more, set);
    }
    std::string refusal(const std::vector<std::string>& set, const std::string& more = "") const {
        try {
            const Scene s = load(more, set);
            RunOptions options;
            options.output = folder / "refused";
            options.quiet = options.force = true;
            run_scene(s, options);
        } catch (const SceneError& error) {
            return error.what();
        } catch (const UsageError& error) {
            return error.what();
        }
        return "";
    }
};

TEST_F(ElasticBaseRun, LoadsBesideDiscsEndInTheSameBitsAfterAResumeAndWithTwoThreads) {
    const Scene s = load(loads + "[basin_water]\n");
    const json whole = run(s, "whole");
    run(s, "parts", 25.0);
    const json parts = run(s, "parts", {}, true);
    EXPECT_EQ(parts["state_hash"], whole["state_hash"]);
    EXPECT_EQ(parts["base_resolved_difference"], whole["base_resolved_difference"]);
    EXPECT_EQ(run(s, "threads", {}, false, 2)["state_hash"], whole["state_hash"]);
    EXPECT_THAT(whole["effects"], AllOf(Contains("lower_crust_thinning"),
                                        Contains("footwall_erosion"), Contains("basin_water")));
    // The load of the second step of 25 m; a cycle goes beyond it by 1e-3 m.
    EXPECT_NEAR(whole["lower_crust_thinning_m"], 20000.0 * 50.0 / (15000.0 + 50.0), 0.01);
    EXPECT_TRUE(whole.contains("footwall_eroded_m2"));
}

TEST_F(ElasticBaseRun, WaterHoldsTheBaseDown) {
    const Scene wet = load("[basin_water]\n");
    const json dry = run(load(), "dry"), filled = run(wet, "wet");
    const double water = filled["basin_water_n_per_m"];
    // Its weight alone on the footwall lowers the breakaway; the discs' load hardly changes.
    const double lower =
        dry["footwall_uplift_m"].get<double>() - filled["footwall_uplift_m"].get<double>();
    const State end = read_snapshot(list_snapshots(folder / "wet").back()).state;
    const auto footwall = fem::make_footwall(make_footwall_request(wet, make_parts(wet)));
    fem::Load load;
    load.interface = interface_loads(end);
    load.interface.resize(2 * footwall->interface().size(), 0.0);
    footwall->solve(load);
    const double alone = -footwall->interface_displacement()[1];
    std::printf("water of %.3g N/m: lower by %.2f m, on the footwall alone %.2f m\n", water, lower,
                alone);
    EXPECT_GT(water, 0.0);
    EXPECT_LT(filled["base_resolved_difference"].get<double>(), 0.08); // as on a second mesh
    EXPECT_FALSE(last_window_means(end).value().effects.empty());
    EXPECT_NEAR(lower, alone, 0.25 * alone); // as for thinning
    EXPECT_FALSE(dry.contains("basin_water_n_per_m"));
}

TEST_F(ElasticBaseRun, ThinningLowersTheBase) {
    const Scene loaded = load(loads.substr(0, loads.find("[footwall")));
    const json without = run(load(), "without"), thinned = run(loaded, "thinned"),
               with = run(load(loads), "with");
    const auto sinks = [&](const json& s) {
        return without["footwall_uplift_m"].get<double>() - s["footwall_uplift_m"].get<double>();
    };
    const auto footwall = fem::make_footwall(make_footwall_request(loaded, make_parts(loaded)));
    footwall->solve(
        lower_crust_load(*loaded.find<LowerCrustThinningParameters>(), 600.0 * 9.81, 60.0));
    const double alone = -footwall->interface_displacement()[1];
    std::printf("lower by %.2f m, footwall alone %.2f m, filled by %.0f m2: %.2f m\n",
                sinks(thinned), alone, with["footwall_deposited_m2"].get<double>(), sinks(with));
    // Discs rearrange themselves where the base sinks: metres.
    EXPECT_NEAR(sinks(thinned), alone, 0.25 * alone);
    EXPECT_GT(sinks(with), sinks(thinned)); // sediment weighs on the hollow
    EXPECT_GT(with["footwall_deposited_m2"].get<double>(), 15e3 * 5.0);
    EXPECT_FALSE(without.contains("footwall_eroded_m2"));
    EXPECT_FALSE(without.contains("lower_crust_thinning_m"));
}

/// A scene with stages of the wall in place of its distance.
std::string staged(const std::string& stages) {
    std::string text = scene;
    const std::string distance = "distance_m = 60.0\n", detachment = "[detachment]\n";
    text.erase(text.find(distance), distance.size());
    text.insert(text.find(detachment) + detachment.size(), "footwall_top_m = 2000.0\n");
    return text + stages;
}

std::vector<std::map<std::string, double>> rows_of(const fs::path& csv) {
    std::ifstream file(csv);
    std::vector<std::map<std::string, double>> rows;
    std::string head, line, name, value;
    std::getline(file, head);
    while (std::getline(file, line)) {
        std::istringstream names(head), values(line);
        rows.emplace_back();
        while (std::getline(names, name, ',') && std::getline(values, value, ','))
            rows.back()[name] = std::strtod(value.c_str(), nullptr);
    }
    return rows;
}

/// 60 m out and 120 m back, to 60 m of net shortening: the wall first takes rock off the footwall,
/// then brings more than there was. 6 s.
TEST_F(ElasticBaseRun, GoesWithTheLoadThereAndBack) {
    const Scene s =
        SceneRuns::load(staged("[[stage]]\ndistance_m = 60.0\n[[stage]]\ndistance_m = -120.0\n") +
                        loads.substr(0, loads.find("[footwall")));
    const json end = run(s, "back");
    for (const auto& row : rows_of(folder / "back" / "history.csv")) {
        const double e = row.at("extension_m");
        const double thinner = row.at("lower_crust_thinning_m");
        const double loaded = 15000.0 * thinner / (20000.0 - thinner); // at the last step of 25 m
        EXPECT_NEAR(loaded, e, 25.1) << e;
        for (const char* error :
             {"interface_force_error", "interface_moment_error", "interface_work_error"})
            EXPECT_LT(row.at(error), 1e-12) << error << e;
    }
    EXPECT_NEAR(end["extension_m"].get<double>(), -60.0, 0.1);
}

/// That way without the thinning crust. 4 s.
TEST_F(ElasticBaseRun, DeflectionChangesSignWithTheLoad) {
    const Scene s =
        SceneRuns::load(staged("[[stage]]\ndistance_m = 60.0\n[[stage]]\ndistance_m = -120.0\n"));
    run(s, "back");
    // By the end of the way out and of the way back; 60 m take longer than the base lags behind.
    int signs = 0;
    for (const auto& row : rows_of(folder / "back" / "history.csv")) {
        std::printf("%6.1f m: weight off %.3g, load off %.3g N/m, breakaway %.3f m\n",
                    row.at("extension_m"), row.at("weight_change_n_per_m"),
                    row.at("net_wall_load_n_per_m"), row.at("footwall_uplift_m"));
        if (std::abs(std::abs(row.at("extension_m")) - 60.0) > 1.0)
            continue;
        ++signs;
        // 0.98 out, 0.92 back: discs above the breakaway lie on the level ground, some still move.
        EXPECT_NEAR(row.at("net_wall_load_n_per_m") / row.at("weight_change_n_per_m"), 1.0, 0.15);
        EXPECT_GT(row.at("weight_change_n_per_m") * row.at("extension_m"), 0.0);
        EXPECT_GT(row.at("footwall_uplift_m") * row.at("extension_m"), 0.0);
    }
    EXPECT_EQ(signs, 2);
}

TEST_F(ElasticBaseRun, StopsWhereLinearElasticityEnds) {
    const Scene soft = load(loads.substr(0, loads.find("[footwall")),
                            {"elastic_base.young_modulus_pa=2e8", "elastic_base.relaxation=3"});
    try {
        run(soft, "soft");
        FAIL() << "a footwall of clay has carried it";
    } catch (const NumericalFailure& failure) {
        // Strained before 60 m; another step or speed would not help, and is not advised.
        EXPECT_THAT(failure.what(),
                    AllOf(HasSubstr("linear elasticity means up to 10 % and 11.5 degrees"),
                          HasSubstr("a smaller relaxation, stiffens it"),
                          HasSubstr("last good state is"), Not(HasSubstr("time_step_safety"))));
    }
    EXPECT_FALSE(list_snapshots(folder / "soft").empty());
    // The window in which it ended is the last row: its strain or rotation is beyond.
    const auto rows = rows_of(folder / "soft" / "history.csv");
    ASSERT_GT(rows.size(), 1u);
    const auto& last = rows.back();
    EXPECT_TRUE(last.at("strong_rock_strain_max") > 0.10 ||
                last.at("relaxed_rock_strain_max") > 0.10 ||
                last.at("rock_rotation_max_deg") > 11.4);
}

TEST_F(ElasticBaseRun, SaysOnTheWayBackWhereItEnds) {
    const Scene soft =
        SceneRuns::load(staged("[[stage]]\ndistance_m = 10.0\n[[stage]]\ndistance_m = -100.0\n") +
                            loads.substr(0, loads.find("[footwall")),
                        {"elastic_base.young_modulus_pa=2e8", "elastic_base.relaxation=3"});
    try {
        run(soft, "soft");
        FAIL() << "a footwall of clay has carried it";
    } catch (const NumericalFailure& failure) {
        EXPECT_THAT(failure.what(), AllOf(HasSubstr(" m of net extension after "),
                                          HasSubstr("linear elasticity means up to 10 %")));
    }
}

TEST_F(ElasticBaseRun, ASecondMeshGivesTheSameBase) {
    const json s = run(load(), "checked");
    std::printf("mesh twice as fine: elements %.4f, base %.4f\n",
                s["base_elements_difference"].get<double>(),
                s["base_resolved_difference"].get<double>());
    // Four elements along the arc: 3 %. The base keeps up with its load to some percent.
    EXPECT_LT(s["base_elements_difference"].get<double>(), 0.05);
    EXPECT_LT(s["base_resolved_difference"].get<double>(), 0.08);
}

TEST_F(ElasticBaseRun, ExplainNamesTheLoads) {
    const std::string with = explain(load(loads), 1, program_effects()),
                      without = explain(load(), 1, program_effects());
    EXPECT_THAT(with, AllOf(HasSubstr("lower crust: 20 km over 15 km thins by 80 m"),
                            HasSubstr("footwall: over 20 km to its target every 1000 a"),
                            HasSubstr("\n    water in the basin"),
                            Not(HasSubstr("\n    erosion of the footwall:"))));
    EXPECT_THAT(without, AllOf(HasSubstr("not in the model, with what each"),
                               HasSubstr("\n    erosion of the footwall:"),
                               HasSubstr("\n    thinning of the lower crust:"),
                               HasSubstr("\n    water in the basin")));
    EXPECT_THAT(explain(load("[basin_water]\n"), 1, program_effects()),
                AllOf(HasSubstr("basin: water of 1030 kg/m3 up to 0 m"),
                      HasSubstr("sideways thrust of the water"),
                      Not(HasSubstr("\n    water in the basin"))));
    // (3300 - 2700) / (3300 - 2400) of the thinning: what sinks is filled.
    EXPECT_THAT(explain(load("[lower_crust_thinning]\nwidth_m = 15000.0\n",
                             {"elastic_base.mantle_density_kg_per_m3=3300",
                              "elastic_base.crust_density_kg_per_m3=2700",
                              "elastic_base.infill_density_kg_per_m3=2400"}),
                        1, program_effects()),
                HasSubstr("thins by 80 m at most; the mantle in its place\n    lowers a wide area "
                          "by 53 m"));
    EXPECT_THAT(without, HasSubstr("leans on the backstop"));
    EXPECT_THAT(
        explain(SceneRuns::load(staged("[[stage]]\ndistance_m = 60.0\n")), 1, program_effects()),
        HasSubstr("the weight of what lies on the level ground behind the breakaway"));
}

TEST_F(ElasticBaseRun, RefusesToShortenTheLowerCrustAway) {
    const std::string crust = "[[stage]]\ndistance_m = -1500.0\n[lower_crust_thinning]\nwidth_m = ";
    EXPECT_NO_THROW(SceneRuns::load(staged(crust + "1600.0\n")));
    try {
        SceneRuns::load(staged(crust + "1500.0\n"));
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("lower_crust_thinning.width_m: is 1500"),
                                        HasSubstr("shortens it by 1500; widen it")));
    }
}

TEST_F(ElasticBaseRun, LowerCrustLiesInTheFootwall) {
    const auto crust = [&](const std::string& centre) {
        return load("[lower_crust_thinning]\nwidth_m = 15000.0\ncentre_m = " + centre + "\n");
    };
    EXPECT_TRUE(crust("0.0").warnings.empty());
    EXPECT_THAT(crust("-40000.0").warnings,
                testing::ElementsAre(HasSubstr("from its left_m = -40000 to right_m = 50000")));
    EXPECT_THAT(refusal({}, "[lower_crust_thinning]\nwidth_m = 15000.0\ncentre_m = 60000.0\n"),
                HasSubstr("lower_crust_thinning.centre_m: is 60000"));
}

TEST_F(ElasticBaseRun, RefusesFillAsDenseAsTheMantle) {
    EXPECT_THAT(refusal({"footwall_erosion.sediment_density_kg_per_m3=3300"}, loads),
                HasSubstr("sediment_density_kg_per_m3: is 3300"));
    EXPECT_THAT(refusal({"basin_water.density_kg_per_m3=3300"}, "[basin_water]\n"),
                HasSubstr("basin_water.density_kg_per_m3: is 3300"));
}

TEST_F(ElasticBaseRun, ChecksTheElementsOfItsEndAtTheStart) {
    // 20,000 km over 1e5 are 200 m, which the check at the end would halve to less.
    EXPECT_THAT(refusal({"elastic_base.left_m=-1e7", "elastic_base.right_m=1e7",
                         "elastic_base.cell_size_m=300"}),
                HasSubstr("elastic_base.cell_size_m: is 300"));
    EXPECT_THAT(refusal({"elastic_base.left_m=-1"}), HasSubstr("move the left side out"));
}

TEST_F(ElasticBaseRun, NeedsAFlatBelowTheRightWall) {
    EXPECT_THAT(refusal({"detachment.start_dip_deg=30",
                         "detachment.segments=[{arc={radius_m=11196.0, end_dip_deg=0.0}},"
                         "{line={length_m=10000.0}}]"}),
                AllOf(HasSubstr("hanging_wall.length_m: is 4000"), HasSubstr("at least 5598")));
}

TEST_F(ElasticBaseRun, RefusesAStateOfAnotherBase) {
    const Scene s = load();
    const ModelParts parts = make_parts(s);
    std::vector<std::unique_ptr<Event>> events;
    const auto driver = make_base_driver(s, parts, {}, events);
    const auto* const base = dynamic_cast<ElasticBase*>(&driver->response());
    ASSERT_TRUE(base);
    State state;
    base->attach(state);
    EXPECT_NO_THROW(driver->require_own(state));
    EXPECT_FALSE(mesh_checksum(state)); // only with a mesh file
    base_node_columns(state).x[3] += 1.0;
    EXPECT_THROW(driver->require_own(state), UsageError);
    State longer;
    base->attach(longer);
    longer.base_nodes.resize(longer.base_nodes.rows() + 2);
    EXPECT_THROW(driver->require_own(longer), UsageError);
}

/// Writes the coarse elements that the program would make as a Gmsh file.
void write_mesh(const fem::FootwallRequest& request, const fs::path& file) {
    const fem::BlockMesh mesh = fem::make_blocks(request);
    std::ofstream out(file);
    out.precision(17);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << mesh.vertices.size() << '\n';
    for (std::size_t k = 0; k < mesh.vertices.size(); ++k)
        out << k + 1 << ' ' << mesh.vertices[k].x << ' ' << mesh.vertices[k].y << " 0\n";
    const auto sides = std::ranges::count_if(
        mesh.edges, [](const fem::BlockMesh::Edge& edge) { return edge.boundary.has_value(); });
    out << "$EndNodes\n$Elements\n" << mesh.cells.size() + static_cast<std::size_t>(sides) << '\n';
    int number = 0;
    for (const fem::BlockMesh::Edge& edge : mesh.edges)
        if (edge.boundary)
            out << ++number << " 1 2 " << static_cast<int>(*edge.boundary) << " 1 "
                << edge.start + 1 << ' ' << edge.end + 1 << '\n';
    for (const auto& [v] : mesh.cells)
        out << ++number << " 3 2 6 1 " << v[0] + 1 << ' ' << v[1] + 1 << ' ' << v[3] + 1 << ' '
            << v[2] + 1 << '\n';
    out << "$EndElements\n";
}

TEST_F(ElasticBaseRun, GoesOnOnlyWithTheMeshThatItBeganWith) {
    const fs::path file = folder / "own.msh";
    const Scene plain = load();
    write_mesh(make_footwall_request(plain, make_parts(plain)), file);
    const Scene s =
        load("", {"elastic_base.mesh_file=" + file.string(), "elastic_base.refinements=2"});
    run(s, "mesh", 25.0);
    const std::string mesh = contents(file);
    std::ofstream(file) << mesh << "$Comments\nanother\n$EndComments\n";
    try {
        run(s, "mesh", {}, true);
        FAIL() << "another mesh was taken for the run's";
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("elastic_base.mesh_file: "),
                                        HasSubstr("own.msh has changed since the run began")));
    }
    std::ofstream(file) << mesh;
    EXPECT_TRUE(run(s, "mesh", {}, true).contains("base_elements_difference"));
}

TEST_F(ElasticBaseRun, RefusesBadInput) {
    EXPECT_THAT(refusal({"elastic_base.poisson_ratio=0.5"}), HasSubstr("below 0.5"));
    EXPECT_THAT(refusal({"elastic_base.young_modulus_pa=-7e10"}), HasSubstr("at least 1e6"));
    EXPECT_THAT(refusal({"elastic_base.depth_m=1600"}),
                HasSubstr("the detachment leaves the mesh: it reaches a depth of 1500 m"));
    EXPECT_THAT(refusal({"elastic_base.right_m=4500"}), HasSubstr("elastic_base.right_m: is 4500"));
    const std::string two = "elastic_base.layers=[{top_depth_m=0.0, density_kg_per_m3=2600.0},"
                            "{top_depth_m=DEPTH, young_modulus_pa=YOUNG, poisson_ratio=NU}]";
    const auto layers = [&](const std::string& depth, const std::string& young,
                            const std::string& nu) {
        std::string text = two;
        for (const auto& [name, value] :
             {std::pair("DEPTH", depth), std::pair("YOUNG", young), std::pair("NU", nu)})
            text.replace(text.find(name), std::string(name).size(), value);
        return std::vector<std::string>{text};
    };
    EXPECT_THAT(refusal(layers("0.0", "5e10", "0.25")),
                HasSubstr("layer 2 overlaps the one before"));
    EXPECT_THAT(refusal(layers("9000.0", "5e10", "0.25")), HasSubstr("above the base at 5000"));
    EXPECT_THAT(refusal(layers("2000.0", "-5e10", "0.25")),
                HasSubstr("elastic_base.layers[1].young_modulus_pa: out of range"));
    EXPECT_THAT(refusal(layers("2000.0", "5e10", "0.5")),
                HasSubstr("elastic_base.layers[1].poisson_ratio: out of range"));
    EXPECT_THAT(refusal({"elastic_base.solver=gamg"}), HasSubstr("allowed: mumps"));
    EXPECT_THAT(refusal({"elastic_base.left_side=free", "elastic_base.right_side=free"}),
                HasSubstr("nothing holds the footwall sideways"));
    EXPECT_THAT(refusal({"elastic_base.mesh_file=none.msh"}), HasSubstr("none.msh: no such file"));
    EXPECT_THAT(refusal({std::string("elastic_base.mesh_file=") + source_folder +
                         "/meshes/lis1-footwall.msh"}),
                HasSubstr("does not match the scene"));
    EXPECT_THAT(refusal({"elastic_base.infill_density_kg_per_m3=1030"}, loads),
                HasSubstr("fills hollows itself"));
    EXPECT_THAT(refusal({}, "[base_motion]\nuplift = [[0.0, 1.0]]\n"),
                HasSubstr("beside [elastic_base]"));
    SceneRequest request;
    request.scene = "lis1";
    request.set = {"lower_crust_thinning={}"};
    EXPECT_THROW(load_scene(request), SceneError);
}

TEST_F(ElasticBaseRun, RefusesAnInvertedMesh) {
    std::ifstream in(std::string(source_folder) + "/meshes/lis1-footwall.msh");
    std::ofstream out(folder / "inverted.msh");
    bool turned = false;
    for (std::string line; std::getline(in, line); out << line << '\n') {
        std::istringstream words(line);
        std::vector<std::string> w{std::istream_iterator<std::string>(words), {}};
        if (!turned && w.size() == 9 && w[1] == "3") { // a quadrilateral: two nodes change places
            line = fmt::format("{} {} {} {} {} {} {} {} {}", w[0], w[1], w[2], w[3], w[4], w[5],
                               w[8], w[7], w[6]);
            turned = true;
        }
    }
    out.close();
    ASSERT_TRUE(turned);
    EXPECT_THAT(refusal({"elastic_base.mesh_file=" + (folder / "inverted.msh").string()}),
                HasSubstr("is inverted or folded"));
}

TEST_F(ElasticBaseRun, LayersAndSidesAreWrittenAndReadBack) {
    const Scene s = load("", {"elastic_base.layers=[{top_depth_m=0.0, young_modulus_pa=5e10},"
                              "{top_depth_m=2000.0, poisson_ratio=0.3}]",
                              "elastic_base.left_side=elastic", "elastic_base.refinements=1"});
    std::ofstream(folder / "again.toml") << to_toml(s);
    SceneRequest request;
    request.scene = (folder / "again.toml").string();
    const Scene again = load_scene(request);
    ASSERT_EQ(again.find<ElasticBaseParameters>()->layers.size(), 2u);
    EXPECT_EQ(again.find<ElasticBaseParameters>()->layers[0].young_modulus, 5e10);
    EXPECT_EQ(again.find<ElasticBaseParameters>()->layers[1].poisson_ratio, 0.3);
    EXPECT_EQ(again.find<ElasticBaseParameters>()->layers[1].top_depth, 2000.0);
    EXPECT_EQ(again.find<ElasticBaseParameters>()->left_side, fem::Side::elastic);
    EXPECT_EQ(again.find<ElasticBaseParameters>()->refinements, 1);
    EXPECT_EQ(to_toml(again), to_toml(s));
}

TEST_F(ElasticBaseRun, AMissingOrStrangePluginIsNamedWithTheCure) {
    load(); // leaves its file
    for (const auto& [plugin, cure] : {std::pair("/nowhere/none.so", "libdeal.ii-dev petsc-dev"),
                                       std::pair("libm.so.6", "of this build; build again")}) {
        const std::string call = fmt::format("LISTRIC_FEM_PLUGIN={2} {0} run {1}/small.toml "
                                             "--output {1}/out --force --quiet 2>&1",
                                             program_path, folder.string(), plugin);
        FILE* pipe = popen(call.c_str(), "r");
        ASSERT_TRUE(pipe);
        std::string said;
        for (int c; (c = std::fgetc(pipe)) != EOF;)
            said += static_cast<char>(c);
        const int status = pclose(pipe);
        EXPECT_TRUE(WIFEXITED(status));
        EXPECT_EQ(WEXITSTATUS(status), 2) << said;
        EXPECT_THAT(said, AllOf(HasSubstr("elastic_base"), HasSubstr(cure)));
    }
}

} // namespace
} // namespace listric::fem_elastic_base_test
