#include "apps/archive/folder/provenance.hpp"
#include "apps/archive/folder/scene_lines.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/version.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace listric::provenance_test {

using namespace archive;

namespace {

namespace fs = std::filesystem;

class ProvenanceTest : public testing::Test {
protected:
    const fs::path folder = fs::temp_directory_path() / fmt::format("provenance-{}", getpid());

    ProvenanceTest() { fs::create_directories(folder); }
    ~ProvenanceTest() override { fs::remove_all(folder); }
};

TEST_F(ProvenanceTest, ACommentEndsALineButNotWithinAString) {
    EXPECT_THAT(scene_lines("# All parameters in force.\n\nfriction = 0.5  # of the base\n"
                            "report = true # a page\na = \"x # \\\" y\" # z"),
                testing::ElementsAre("friction = 0.5", "a = \"x # \\\" y\""));
}

TEST_F(ProvenanceTest, TheHashIsOfParametersAlone) {
    const Scene scene = load_scene({.scene = "lis1"});
    std::string text = to_toml(scene);
    text.insert(text.find("\n\n"), "\n# Another comment.");
    std::ofstream(folder / "scene.toml") << text;
    const std::string file = (folder / "scene.toml").string();
    EXPECT_EQ(scene_hash(load_scene({.scene = file})), scene_hash(scene));
    EXPECT_NE(scene_hash(load_scene({.scene = file, .set = {"detachment.friction=0.4"}})),
              scene_hash(scene));
    EXPECT_NE(scene_hash(load_scene({.scene = file, .seed = 2})), scene_hash(scene));
    EXPECT_NE(scene_hash(load_scene({.scene = file, .without = {"bond_healing"}})),
              scene_hash(scene));
}

TEST_F(ProvenanceTest, TellsTheProgramAndTheScene) {
    const auto told = provenance(load_scene({.scene = "lis1", .seed = 7}));
    EXPECT_EQ(told["seed"], 7);
    EXPECT_EQ(told["compiler"], compiler);
    EXPECT_EQ(told["instruction_set"], instruction_set);
    EXPECT_EQ(told["scene_hash"].get<std::string>().size(), 16u);
    EXPECT_EQ(told["version"].get<std::string>() +
                  (told.contains("commit") ? "+" + told["commit"].get<std::string>() : ""),
              version);
    EXPECT_EQ(told["version"].get<std::string>().find('+'), std::string::npos);
}

TEST_F(ProvenanceTest, OfARunIsWhatItsSummarySays) {
    const Scene scene = load_scene({.scene = "lis1"});
    // A run of an earlier version does not say which; this program is not it.
    EXPECT_FALSE(provenance_of_run(folder, scene).contains("version"));
    EXPECT_EQ(provenance_of_run(folder, scene)["seed"], 1);
    std::ofstream(folder / "summary.json") << R"({"provenance": {"version": "0.1.9"}})";
    EXPECT_EQ(provenance_of_run(folder, scene)["version"], "0.1.9");
}

} // namespace
} // namespace listric::provenance_test
