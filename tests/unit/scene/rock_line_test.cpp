// Scenes that name no rock have that of the shipped scenes, and people are told which they have.

#include "apps/scene/picks/rock_line.hpp"

#include "apps/archive/tables/rock_record.hpp"
#include "apps/model/effects.hpp"
#include "tests/places.hpp"
#include "tests/small_halfgraben.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace listric::rock_line_test {
namespace {

namespace fs = std::filesystem;
using support::contents;

constexpr const char* shipped =
    "rock: mat18-b; faults: mat18-w-frictional (friction 0.2); sediment: sediment; detachment: "
    "sheet (pulls), friction 0.5";
constexpr const char* without_sediment = "rock: mat18-b; faults: mat18-w-frictional (friction "
                                         "0.2); detachment: sheet (pulls), friction 0.5";

class RockLine : public testing::Test {
protected:
    RockLine() { fs::create_directories(folder); }
    ~RockLine() override { fs::remove_all(folder); }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name) << text;
        return (folder / name).string();
    }
    static std::string line(const std::string& scene, const std::vector<std::string>& set = {}) {
        return rock_line(load_scene({.scene = scene, .set = set}));
    }

    /// The blocks of TOML in a document that are scenes.
    static std::vector<std::string> scenes_in(const fs::path& document) {
        const std::string text = contents(fs::path(source_folder) / document);
        const std::string fence = "```toml\n";
        std::vector<std::string> scenes;
        for (std::size_t at = text.find(fence); at != text.npos; at = text.find(fence, at + 1)) {
            const std::size_t begin = at + fence.size();
            const std::string block = text.substr(begin, text.find("```", begin) - begin);
            if (block.find("[fault_weakening]") != block.npos)
                scenes.push_back(block);
        }
        return scenes;
    }

    const fs::path folder =
        fs::path(testing::TempDir()) / fmt::format("listric-rock-line-{}", getpid());
};

TEST_F(RockLine, ScenesOfTheDocumentsHaveTheShippedRock) {
    write("fault.csv",
          "x_m,depth_m\n0,0\n128,1957\n511,3882\n1141,5740\n2009,7499\n3099,9131\n4393,10606\n5868,"
          "11900\n7499,12990\n9259,13858\n11117,14488\n13042,14871\n14999,15000\n30000,15000\n");
    for (const char* document : {"README.md", "docs/start/your-own-section.md"}) {
        const auto scenes = scenes_in(document);
        EXPECT_EQ(scenes.size(), 1u) << document;
        for (const std::string& scene : scenes)
            EXPECT_THAT(line(write("scene.toml", scene)), testing::AnyOf(shipped, without_sediment))
                << document;
    }
    // The tutorial makes these tables.
    fs::copy_file(fs::path(source_folder) / "docs/start/your-own-section/scene.toml",
                  folder / "tutorial.toml", fs::copy_options::overwrite_existing);
    write("picks.csv", "name,x_m,depth_m\na,3000,100\na,4000,200\n");
    EXPECT_EQ(line((folder / "tutorial.toml").string()), shipped);
    for (const auto& entry :
         fs::directory_iterator(fs::path(source_folder) / "docs/guides/cookbook")) {
        const bool is_scene = contents(entry.path()).find("[fault_weakening]") != std::string::npos;
        EXPECT_EQ(is_scene ? line(entry.path().string()) : shipped, shipped) << entry.path();
    }
    for (const char* scene : {"lis1", "lis2", "rfr", "lis1-elastic", "lis2-elastic", "rfr-elastic"})
        EXPECT_EQ(line(scene), shipped) << scene;
}

TEST_F(RockLine, NamesWhatIsInForce) {
    EXPECT_EQ(line("pure-shear"), "rock: mat18-b; faults: mat18-w (friction 0); base friction 0.3");
    EXPECT_EQ(line("lis1-0"),
              "rock: mat18-b; sediment: sediment; detachment: sheet (pulls), friction 0.5");
    // The name is what the scene says; what it changes is told beside it, though the numbers may be
    // those of another rock then.
    EXPECT_EQ(line("lis1", {"fault_weakening.friction=0.3", "detachment.friction=0.1"}),
              "rock: mat18-b; faults: mat18-w-frictional, friction changed (friction 0.3); "
              "sediment: sediment; detachment: sheet (pulls), friction 0.1");
    EXPECT_EQ(line("lis1", {"fault_weakening.friction=0"}),
              "rock: mat18-b; faults: mat18-w-frictional, friction changed (friction 0); sediment: "
              "sediment; detachment: sheet (pulls), friction 0.5");
    EXPECT_EQ(line("lis1", {"sedimentation.friction=0.3"}).find("sediment: mat18-b"),
              std::string::npos);
    EXPECT_THAT(line("lis1-mud"), testing::HasSubstr("; sediment: sediment, friction changed;"));
    EXPECT_EQ(line("lis1", {"bonds.shear_strength_pa=9e9"}).substr(0, 43),
              "rock: mat18-b, shear_strength_pa changed; f");
    const std::string sandstone =
        (fs::path(source_folder) / "docs/guides/cookbook/sandstone.toml").string();
    EXPECT_EQ(line("lis1", {"materials.basement=" + sandstone}).substr(0, 16), "rock: sandstone;");
}

TEST_F(RockLine, NamesTheRocksOfLayersAndWhatTheirTablesChange) {
    const RockOrigins origins =
        rock_origins(load_scene({.scene = "salt-cover", .set = {"layer.0.friction=0.123"}}));
    const auto salt = std::ranges::find(origins, "layer salt", &RockOrigin::of);
    ASSERT_NE(salt, origins.end());
    EXPECT_EQ(salt->name, "salt");
    EXPECT_EQ(salt->changed, std::vector<std::string>{"layer[0].friction"});
}

// Equal numbers do not tell which of two rocks was meant, so nothing is guessed by them.
TEST_F(RockLine, OfARecordAreKnownByWhatWasWrittenDown) {
    const Scene scene = load_scene({.scene = "lis1-mud"});
    const fs::path run = folder / "run";
    fs::create_directories(run / "snapshots");
    std::ofstream(run / "scene.toml") << to_toml(scene);
    const Scene record = load_scene({.scene = (run / "scene.toml").string(), .is_record = true});
    EXPECT_FALSE(archive::known_rocks(record));
    EXPECT_EQ(rock_line(record, archive::known_rocks(record)),
              "rock: not recorded; faults: not recorded (friction 0.5); sediment: not recorded; "
              "detachment: sheet (pulls), friction 0.5");
    for (const char* damaged : {"{", "[]", R"({"rocks": 3})", R"({"rocks": [{"of": 3}]})"}) {
        std::ofstream(run / "status.json") << damaged;
        EXPECT_FALSE(archive::known_rocks(record)) << damaged;
    }
    std::ofstream(run / "status.json")
        << nlohmann::ordered_json{{"rocks", archive::rocks_json(rock_origins(scene))}};
    EXPECT_EQ(rock_line(record, archive::known_rocks(record)), rock_line(scene));
}

TEST_F(RockLine, OlderVersionsTookTable1) {
    const std::string file = write("old.toml", support::small_halfgraben() + "[fault_weakening]\n");
    EXPECT_EQ(
        rock_line(load_scene({.scene = file, .former_rocks = true})),
        "rock: mat18-b; faults: mat18-w (friction 0); detachment: sheet (pulls), friction 0.5");
    // A rock that a scene names holds.
    const std::string named = file.substr(0, file.size() - 5) + "-named.toml";
    write("old-named.toml", contents(file) + "[materials]\nweakened = 'mat18-w-calibrated'\n");
    EXPECT_EQ(rock_line(load_scene({.scene = named, .former_rocks = true})),
              rock_line(load_scene({.scene = named})));
}

} // namespace
} // namespace listric::rock_line_test
