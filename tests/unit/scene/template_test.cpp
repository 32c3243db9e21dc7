// `listric new`: a scene written from another one is the same scene, with comments.

#include "apps/model/effects.hpp"
#include "apps/scene/toml/template.hpp"
#include "apps/support/files/file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <unistd.h>

namespace listric::template_test {
namespace {

namespace fs = std::filesystem;
using testing::ContainsRegex;
using testing::HasSubstr;

class Template : public testing::Test {
protected:
    Template() { fs::create_directories(folder_); }
    ~Template() override { fs::remove_all(folder_); }

    /// The scene that is written from another one, under the same name.
    Scene written(const std::string& from) {
        Scene scene = load_scene({.scene = from});
        const fs::path file = folder_ / (scene.name + ".toml");
        write_text(file, scene_template(from, program_effects()));
        Scene again = load_scene({.scene = file.string()});
        EXPECT_EQ(again.description, "made from " + scene.name);
        again.description = scene.description;
        EXPECT_EQ(to_toml(again), to_toml(scene)) << from;
        return again;
    }

    fs::path folder_ = fs::temp_directory_path() / ("listric-template-" + std::to_string(getpid()));
};

TEST_F(Template, OfEveryShippedSceneIsThatScene) {
    for (const std::string& name : scenes.names())
        written(name);
}

TEST_F(Template, OfAPickedFaultReadsItsFileFromAnotherFolder) {
    const fs::path below = folder_ / "section";
    fs::create_directories(below);
    std::string points = "x_m,depth_m\n"; // a quarter of a circle
    for (double angle = 0.0; angle <= 90.0; angle += 3.0)
        points += fmt::format("{},{}\n", 15e3 * (1.0 - std::cos(angle * std::numbers::pi / 180.0)),
                              15e3 * std::sin(angle * std::numbers::pi / 180.0));
    write_text(below / "fault.csv", points + "75000,15000\n");
    const fs::path scene = below / "own.toml";
    write_text(scene, "[hanging_wall]\nlength_m = 40000\n[detachment]\ncsv = \"fault.csv\"\n"
                      "tolerance_m = 80\n[gravity]\n[bonds]\n");
    EXPECT_TRUE(written(scene.string()).picked_fault);
}

TEST_F(Template, NamesTheRockAndShowsUnitsAndDefaults) {
    const std::string text = scene_template("lis1", program_effects());
    EXPECT_THAT(text,
                ContainsRegex("\n\\[materials\\]\nbasement = \"mat18-b\" .*# material, by name"));
    EXPECT_THAT(text, ContainsRegex("\nlength_m = 40000.0 +# m: length from the breakaway"));
    EXPECT_THAT(text, ContainsRegex("\n# radius_ratio = 1.66 +# largest over smallest"));
    EXPECT_THAT(text, ContainsRegex("\n# \\[elastic_base\\] +# footwall and basement bend"));
}

} // namespace
} // namespace listric::template_test
