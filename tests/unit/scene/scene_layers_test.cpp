// Layers of rock and old faults in a scene: what the file says, and what is refused, each in a line
// with file, line and cure.

#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/parameters/scene_layer.hpp"
#include "apps/scene/picks/old_fault.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "dem/events/old_faults.hpp"
#include "dem/events/property_update.hpp"
#include "tests/message_of.hpp"
#include "tests/support.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <unistd.h>

namespace listric::scene_layers_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string head = "[hanging_wall]\n"
                         "mean_radius_m = 100.0\n"
                         "[detachment]\n"
                         "segments = [{arc = {radius_m = 15e3}}, {line = {length_m = 1e5}}]\n"
                         "[gravity]\n"; // five lines

class SceneLayers : public testing::Test {
protected:
    SceneLayers() { fs::create_directories(folder); }
    ~SceneLayers() override { fs::remove_all(folder); }

    Scene load(const std::string& tables, SceneRequest request = {}) const {
        request.scene = (folder / "scene.toml").string();
        write_text(request.scene, tables.starts_with('#') ? tables : head + tables);
        return load_scene(request);
    }
    std::string error(const std::string& tables, const SceneRequest& request = {}) const {
        return support::scene_message_of([&] { load(tables, request); }, folder);
    }

    static std::string layer(const std::string& name, const std::string& lines) {
        return fmt::format("[[layer]]\nname = \"{}\"\nmaterial = \"mica\"\n{}", name, lines);
    }

    const fs::path folder =
        fs::temp_directory_path() / fmt::format("listric-scene-layers-{}", getpid());
    const std::string mica = layer("mica", "top_m = 2000.0\nthickness_m = 500.0\n");
};

TEST_F(SceneLayers, TakeTheirRockFromItsMaterial) {
    const Scene scene =
        load("[bonds]\n[fault_weakening]\n" + mica +
             "weakens_to = \"none\"\n[[layer]]\nname = \"b\"\nmaterial = \"mat18-b\"\n"
             "top = [[0.0, 5000.0], [40000.0, 6000.0]]\nthickness_m = 800.0\nfriction = 0.3\n"
             "density_kg_per_m3 = 2400.0\nwelded = false\nweakens_to = \"mat18-w\"\n");
    const ModelParts parts = make_parts(scene);
    ASSERT_EQ(parts.materials.size(), 6u); // mica has no weak rock
    const dem::Material& soft = parts.materials[3];
    EXPECT_EQ(soft.normal_stiffness, 8.5e8);
    EXPECT_TRUE(soft.is_soft);
    EXPECT_FALSE(soft.bondable);
    const dem::Material& rock = parts.materials[4];
    EXPECT_EQ(rock.friction, 0.3);
    EXPECT_FALSE(rock.is_soft);
    EXPECT_FALSE(rock.is_welded);
    ASSERT_TRUE(rock.bonds);
    EXPECT_EQ(rock.bonds->tensile_mean, 2e4);
    EXPECT_EQ(parts.materials[5].weak_of, 4);
    EXPECT_EQ(parts.materials[5].friction, 0.0);
    ASSERT_EQ(parts.layers.size(), 2u);
    EXPECT_EQ(parts.layers[1].rock.density, 2400.0);
    EXPECT_DOUBLE_EQ(parts.layers[1].rock.top.height(20e3), -5500.0);
    EXPECT_DOUBLE_EQ(parts.layers[1].rock.bottom.height(20e3), -6300.0);
    EXPECT_TRUE(parts.layers[0].rock.contains({1e3, -2200.0}));
    EXPECT_FALSE(parts.layers[0].rock.contains({1e3, -1900.0}));
}

TEST_F(SceneLayers, AreReadBackAsWritten) {
    const std::string written =
        to_toml(load("[bonds]\n" + mica +
                     layer("b", "top = [[0.0, 5000.0]]\nbottom_m = 6000.0\nwelded = false\n")));
    EXPECT_EQ(to_toml(load("# written\n" + written)), written);
    EXPECT_THAT(written, HasSubstr("[[layer]]"));
}

TEST_F(SceneLayers, SoftOnesKeepTheirVolumeWithoutFaultWeakening) {
    const Scene scene = load(mica);
    EXPECT_TRUE(dem::find<dem::PropertyUpdate>(make_events(scene, make_parts(scene))));
    const Scene stiff = load(mica + "normal_stiffness_pa = 1.7e11\n");
    EXPECT_FALSE(dem::find<dem::PropertyUpdate>(make_events(stiff, make_parts(stiff))));
}

TEST_F(SceneLayers, ThatCannotBeAreRefused) {
    EXPECT_THAT(error(mica + layer("other", "top_m = 2400.0\nthickness_m = 500.0\n")),
                StartsWith("scene.toml:11: layer[1]: other overlaps mica at x = 0, from 2400 to "
                           "2500 m of depth"));
    EXPECT_THAT(error(layer("a", "top_m = 2000.0\nbottom_m = 1500.0\n")),
                StartsWith("scene.toml:6: layer[0]: a is upside down at x = 0"));
    EXPECT_THAT(error(layer("a", "top_m = 2000.0\nthickness_m = 100.0\n")),
                StartsWith("scene.toml:6: layer[0]: a is 100 m thick, less than a mean disc "
                           "diameter (200 m); accuracy = \"fine\" or hanging_wall.mean_radius_m = "
                           "50 would do"));
    EXPECT_THAT(error(layer("a", "top_m = 15100.0\nthickness_m = 500.0\n")),
                HasSubstr("layer[0]: a is below the detachment everywhere"));
    EXPECT_THAT(error(layer("a", "top = [[0.0, 1e3], [5e4, 1e3]]\nthickness_m = 500.0\n")),
                HasSubstr("layer[0].top[1]: x = 50000 is outside of the hanging wall, allowed: 0 "
                          "to 40000"));
    EXPECT_THAT(error(layer("a", "top = [[2e3, 1e3], [1e3, 1e3]]\nthickness_m = 500.0\n")),
                HasSubstr("layer[0].top[1]: is not sorted: x = 1000 comes after 2000"));
    EXPECT_THAT(error(layer("a", "top = [[0.0, 1e3], [4e4, 3e3]]\nbottom_m = 2000.0\n")),
                HasSubstr("layer[0]: a is upside down at x = 20100"));
    EXPECT_THAT(error("[[layer]]\nname = \"a\"\nmaterial = \"mika\"\ntop_m = 0.0\n"),
                HasSubstr("layer[0].material"));
    EXPECT_THAT(error("[[layer]]\nname = \"a\"\nmaterial = \"mika\"\ntop_m = 0.0\n"),
                HasSubstr("did you mean mica?"));
    EXPECT_THAT(error(mica + "weakens_to = \"mat18-b\"\n"),
                StartsWith("scene.toml:11: layer[0].weakens_to: mat18-b has bonds"));
    EXPECT_THAT(error(mica + "welded = false\n"),
                StartsWith("scene.toml:11: layer[0].welded: is about bonds, and the scene has "
                           "none; add [bonds]"));
    EXPECT_THAT(error(mica + "tensile_strength_pa = 1e4\n"),
                StartsWith("scene.toml:11: layer[0].tensile_strength_pa: is about bonds, and the "
                           "scene has none; add [bonds]"));
    EXPECT_THAT(error("[bonds]\n" + mica + "weakened_friction = 0.7\n"),
                StartsWith("scene.toml:12: layer[0].weakened_friction: is about weakened rock"));
    // Strengths of a shelf's rock, and an effect that is left out for once, are no slips.
    EXPECT_EQ(error("[[layer]]\nname = \"a\"\nmaterial = \"mat18-b\"\ntop_m = 2e3\n"
                    "thickness_m = 500.0\n"),
              "no error");
    EXPECT_EQ(error("[bonds]\n[fault_weakening]\n" + mica + "weakened_friction = 0.7\n",
                    {.without = {"fault_weakening"}}),
              "no error");
    EXPECT_THAT(error(mica + "bottom_m = 3000.0\n"), HasSubstr("has several bottoms"));
    EXPECT_THAT(error(layer("a", "top_m = 2000.0\n")), HasSubstr("has no bottom"));
    EXPECT_THAT(error(layer("a", "thickness_m = 2000.0\n")), HasSubstr("has no top"));
    EXPECT_THAT(error("[[layer]]\ntop_m = 0.0\nthickness_m = 500.0\n"), HasSubstr("needs name"));
    EXPECT_THAT(error(mica + layer("mica", "top_m = 4e3\nthickness_m = 500.0\n")),
                HasSubstr("\"mica\" is the name of two layers"));
    EXPECT_THAT(error("[[layer]]\nname = \"a\"\ntop_m = 0.0\nthickness_m = 500.0\n"),
                HasSubstr("a needs material"));
    std::string many;
    for (int k = 0; k < 99; ++k)
        many += layer(std::to_string(k), "top_m = 0.0\nthickness_m = 500.0\n");
    EXPECT_THAT(error(many), HasSubstr("there are 99, which makes 201 materials, allowed: 200"));
}

TEST_F(SceneLayers, ComeFromFiles) {
    write_text(folder / "top.csv", "x_m,depth_m\n0,1000\n40000,2000\n");
    const Scene scene = load(layer("a", "top_csv = \"top.csv\"\nthickness_m = 500.0\n"));
    EXPECT_DOUBLE_EQ(scene.find<listric::SceneLayers>()->front().top_at(20e3), 1500.0);
    write_text(folder / "top.csv", "x_m,depth_m\n0,1000\n0,2000\n");
    EXPECT_THAT(error(layer("a", "top_csv = \"top.csv\"\nthickness_m = 500.0\n")),
                StartsWith("top.csv:3: x_m: 0 comes after 0; sort the rows by x"));
    write_text(folder / "top.csv", "x_m,depth_m\n0,1000\n40000,-2000\n");
    EXPECT_THAT(error(layer("a", "top_csv = \"top.csv\"\nthickness_m = 500.0\n")),
                StartsWith("top.csv:3: depth -2000 is out of range"));
    EXPECT_THAT(error(layer("a", "top_csv = \"none.csv\"\nthickness_m = 500.0\n")),
                HasSubstr("no such file"));
}

TEST_F(SceneLayers, ThinOnesAreWarnedOf) {
    const Scene scene = load(layer("a", "top_m = 2000.0\nthickness_m = 300.0\n"));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings.front(), HasSubstr("hardly slip"));
    EXPECT_TRUE(load(mica).warnings.empty());
}

TEST_F(SceneLayers, OfAnotherDensityThanGrainsHaveNoPoreFluid) {
    const std::string wet = "[sedimentation]\n[compaction]\n[pore_fluid]\n",
                      place = "top = [[0.0, 2e3]]\nbottom = [[0.0, 4e3]]\n";
    EXPECT_THAT(error(wet + layer("salt", place + "density_kg_per_m3 = 2200.0\n")),
                HasSubstr("layer[0].density_kg_per_m3: is 2200 beside [pore_fluid]"));
    EXPECT_EQ(error(wet + layer("salt", place + "density_kg_per_m3 = 2600.0\n")), "no error");
}

class SceneOldFaults : public SceneLayers {};

TEST_F(SceneOldFaults, AreWeakFromTheStart) {
    const std::string fault =
        "[bonds]\n[fault_weakening]\n[[old_fault]]\npoints = [[14e3, 9e3], [19e3, 1e3]]\n";
    const Scene scene = load(fault);
    EXPECT_TRUE(dem::find<dem::OldFaults>(make_events(scene, make_parts(scene))));
    EXPECT_EQ(to_toml(load("# written\n" + to_toml(scene))), to_toml(scene));
    write_text(folder / "faults.csv", "line,name,x_m,depth_m,slip_m\n0,fault 0,14000,9000,1\n"
                                      "0,fault 0,19000,1000,2\n1,fault 1,24000,9000,1\n"
                                      "1,fault 1,22000,1000,2\n");
    const Scene read = load("[bonds]\n[fault_weakening]\n[[old_fault]]\ncsv = \"faults.csv\"\n");
    EXPECT_EQ(read.find<OldFaultList>()->front().lines.size(), 2u);
    EXPECT_EQ(to_toml(load("# written\n" + to_toml(read))), to_toml(read));
}

TEST_F(SceneOldFaults, InPiecesHaveNothingBetweenThem) {
    const std::string scene = "[bonds]\n[fault_weakening]\n[[old_fault]]\ncsv = \"faults.csv\"\n";
    const auto read = [&](const std::string& table) {
        write_text(folder / "faults.csv", table);
        return load(scene);
    };
    const auto lengths = [](const Scene& loaded) {
        std::vector<std::size_t> points;
        for (const PickedLine& line : loaded.find<OldFaultList>()->front().lines) {
            EXPECT_EQ(line.name, "F1");
            points.push_back(line.x.size());
        }
        return points;
    };
    using testing::ElementsAre;
    const std::string rows[] = {"F1,9000,500\n", "F1,11000,4000\n", "F1,15000,500\n",
                                "F1,17000,4000\n"};
    const std::string head = "name,x_m,depth_m\n";
    // As `listric export` numbers lines, as segments, by an empty line, by a row of empty cells.
    for (const std::string column : {"line", "Line", "segment"})
        EXPECT_THAT(lengths(read(column + "," + head + "0," + rows[0] + "0," + rows[1] + "1," +
                                 rows[2] + "1," + rows[3])),
                    ElementsAre(2, 2))
            << column;
    for (const std::string gap : {"\n", "\r\n", "  \n", ",,\n", "# two\n\n"})
        EXPECT_THAT(lengths(read(head + rows[0] + rows[1] + gap + rows[2] + rows[3])),
                    ElementsAre(2, 2))
            << gap;
    // A comment is no gap; lines that are all apart are one; a column says more than a gap.
    const Scene joined = read(head + rows[0] + rows[1] + "# two\n" + rows[2] + rows[3]);
    EXPECT_THAT(lengths(joined), ElementsAre(4));
    ASSERT_EQ(joined.warnings.size(), 1u);
    EXPECT_THAT(joined.warnings[0], HasSubstr("faults.csv:5: F1 turns back here; if it is in "
                                              "pieces, part them by an empty line"));
    EXPECT_THAT(
        lengths(read(head + rows[0] + "\n" + rows[1] + "\n" + rows[2] + "\n" + rows[3] + "\n")),
        ElementsAre(4));
    EXPECT_THAT(lengths(read("line," + head + "0," + rows[0] + "\n0," + rows[1] + "1," + rows[2] +
                             "1," + rows[3])),
                ElementsAre(2, 2));
    // Events, messages and the scene that a run writes have both pieces.
    const Scene pieces = read(head + rows[0] + rows[1] + "\n" + rows[2] + rows[3]);
    EXPECT_TRUE(pieces.warnings.empty());
    EXPECT_EQ(to_toml(load("# written\n" + to_toml(pieces))), to_toml(pieces));
    EXPECT_THAT(error(scene), "no error");
    write_text(folder / "faults.csv", head + rows[0] + rows[1] + "\n" + rows[2]);
    EXPECT_THAT(error(scene), HasSubstr("F1 has one point, needs at least two"));
}

TEST_F(SceneOldFaults, ThatCannotBeAreRefused) {
    const auto refused = [&](const std::string& lines) {
        return error("[bonds]\n[fault_weakening]\n[[old_fault]]\n" + lines);
    };
    EXPECT_THAT(error("[[old_fault]]\npoints = [[14e3, 9e3], [19e3, 1e3]]\n"),
                StartsWith("scene.toml:6: old_fault: needs [fault_weakening]"));
    EXPECT_THAT(refused("points = [[50e3, 9e3], [51e3, 1e3]]\n"),
                StartsWith("scene.toml:8: old_fault[0]: the fault is outside of the hanging wall"));
    // One that crosses the whole hanging wall has its ends outside.
    EXPECT_EQ(refused("points = [[14e3, -50.0], [19e3, 20e3]]\n"), "no error");
    EXPECT_THAT(refused("points = [[14e3, 9e3]]\n"),
                StartsWith("scene.toml:8: old_fault[0]: the fault has one point"));
    EXPECT_THAT(refused("points = [[14e3, 9e3], [14.1e3, 9e3]]\n"),
                StartsWith("scene.toml:8: old_fault[0]: the fault is 100 m long, shorter than its "
                           "band is wide (400 m)"));
    EXPECT_THAT(refused("name = \"a\"\n"), HasSubstr("needs points"));
}

TEST_F(SceneOldFaults, ThatWeakenNoDiscEndTheRun) {
    const Scene scene = load("[bonds]\n[fault_weakening]\n[[old_fault]]\nname = \"east\"\n"
                             "points = [[14e3, 9e3], [19e3, 1e3]]\n");
    const auto events = make_events(scene, make_parts(scene));
    auto* faults = dem::find<dem::OldFaults>(events);
    ASSERT_TRUE(faults);
    dem::State state = support::make_state({{.x = 35e3, .y = -500.0, .radius = 100.0}});
    faults->begin(state);
    try {
        faults->start(state, {});
        FAIL() << "nothing said";
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), StartsWith("old_fault[0], east: no disc of rock"));
        EXPECT_THAT(error.what(), HasSubstr("400 m wide; raise band_width_diameters"));
    }
}

} // namespace
} // namespace listric::scene_layers_test
