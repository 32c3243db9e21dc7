// Arrays of tables in a scene, [[name]]: an effect that the program does not have is read from
// several tables, changed by --set, refused, written and compared as effects of one table are.

#include "apps/archive/folder/scene_lines.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/scene/toml/differences.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/scene/toml/schema.hpp"
#include "apps/scene/toml/tables.hpp"
#include "apps/scene/toml/template.hpp"
#include "apps/support/files/file.hpp"
#include "tests/message_of.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <unistd.h>

namespace listric::table_array_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct Marker {
    std::string name;
    double depth = 1000.0; // m
    std::optional<double> width;
    double content = 0.0; // of its file
};
using Markers = std::vector<Marker>;

const Effect& marker() {
    static const Effect effect{
        .name = "marker",
        .doc = "a marker of the test",
        .defaults = make_defaults<Markers>,
        .address = address_of<Markers>,
        .parameters = {{"name", at<&Marker::name>, "", ranges::any, "", "its name"},
                       {"depth_m", at<&Marker::depth>, "m", between(0, 1e4), "", "its depth"},
                       {"width_km",
                        at<&Marker::width>,
                        "km",
                        between(0, 100),
                        "",
                        "its width",
                        "",
                        {},
                        1e-3}},
        .items = items_of<Marker>,
        .files = {{"csv", "its points", "", nullptr,
                   [](Scene& scene, std::size_t item, const std::string& file, const Refuse&) {
                       (*scene.find<Markers>())[item].content =
                           static_cast<double>(fs::file_size(file));
                   }}},
        .check =
            [](const Scene& scene, const Refuse& refuse) {
                const Markers& all = *scene.find<Markers>();
                for (std::size_t k = 0; k < all.size(); ++k)
                    if (all[k].name == "bad")
                        refuse(fmt::format("marker[{}].name", k), "is bad");
                    else if (all[k].name == "no width" && !all[k].width)
                        refuse(fmt::format("marker[{}].width_km", k), "is missing");
            },
    };
    return effect;
}

EffectList effects() {
    static const std::vector<const Effect*> list = [] {
        std::vector<const Effect*> all(program_effects().begin(), program_effects().end());
        all.insert(all.begin(), &marker());
        return all;
    }();
    return list;
}

const std::string head = "[hanging_wall]\n"
                         "[detachment]\n"
                         "segments = [{arc = {radius_m = 15e3}}, {line = {length_m = 1e5}}]\n"
                         "[gravity]\n";

class TableArray : public testing::Test {
protected:
    TableArray() { fs::create_directories(folder); }
    ~TableArray() override { fs::remove_all(folder); }

    Scene load(const std::string& tables, SceneRequest request = {}) const {
        request.scene = (folder / "scene.toml").string();
        write_text(request.scene, tables.starts_with('#') ? tables : head + tables);
        return load_scene(request, effects());
    }
    std::string error(const std::string& tables, const SceneRequest& request = {}) const {
        return support::scene_message_of([&] { load(tables, request); }, folder);
    }
    static std::vector<std::string> names(const Scene& scene) {
        std::vector<std::string> all;
        if (const Markers* markers = scene.find<Markers>())
            for (const Marker& one : *markers)
                all.push_back(fmt::format("{} {}", one.name, one.depth));
        return all;
    }

    const fs::path folder =
        fs::temp_directory_path() / fmt::format("listric-table-array-{}", getpid());
    const std::string two = "[[marker]]\nname = \"a\"\n[[marker]]\ndepth_m = 2000.0\n";
};

TEST_F(TableArray, HasItsTablesInTheOrderOfTheFile) {
    EXPECT_THAT(names(load("")), ElementsAre());
    const Scene scene = load(two);
    EXPECT_THAT(names(scene), ElementsAre("a 1000", " 2000"));
    EXPECT_EQ(scene.effects.front().effect, &marker()); // in the order of the program's list
    EXPECT_EQ(load("[[marker]]\nwidth_km = 3.0\n").find<Markers>()->front().width, 3000.0);
}

TEST_F(TableArray, IsSetByNumber) {
    EXPECT_THAT(names(load(two, {.set = {"marker.1.name=c", "marker.0.depth_m=5"}})),
                ElementsAre("a 5", "c 2000"));
    EXPECT_THAT(names(load(two, {.set = {"marker.2.name=new"}})),
                ElementsAre("a 1000", " 2000", "new 1000"));
    EXPECT_THAT(names(load("", {.set = {"marker.0.depth_m=7"}})), ElementsAre(" 7"));
    EXPECT_THAT(names(load(two, {.set = {"marker.1={name = \"whole\"}"}})),
                ElementsAre("a 1000", "whole 2000"));
    EXPECT_THAT(names(load(two, {.set = {"marker=[{}, {}, {}]"}})),
                ElementsAre(" 1000", " 1000", " 1000"));
    EXPECT_THAT(names(load(two, {.without = {"marker"}})), ElementsAre());
}

TEST_F(TableArray, RefusesWithTheLineOfTheTable) {
    EXPECT_EQ(error(two + "[[marker]]\ndepth_m = 2e4\n"),
              "scene.toml:10: marker[2].depth_m: out of range (20000), allowed: at least 0, at "
              "most 10000");
    EXPECT_EQ(error(two + "[[marker]]\ndeph_m = 2.0\n"),
              "scene.toml:10: marker[2].deph_m: unknown key, did you mean depth_m?");
    EXPECT_EQ(error(two + "[[marker]]\nname = \"bad\"\n"), "scene.toml:10: marker[2].name: is bad");
    EXPECT_EQ(error(two + "[[marker]]\nname = \"no width\"\n"), // not there: the table's line
              "scene.toml:9: marker[2].width_km: is missing");
    EXPECT_THAT(error("[marker]\nname = \"a\"\n"),
                AllOf(HasSubstr("scene.toml:5: marker: is of several tables"),
                      HasSubstr("[[marker]]"), HasSubstr("marker.0.key")));
    EXPECT_THAT(error("[[markr]]\n"), HasSubstr("did you mean marker?"));
    EXPECT_EQ(error(two, {.set = {"marker.3.name=x"}}),
              "--set marker.3.name=x: marker.3: there are 2, counted from 0; the next is marker.2");
    EXPECT_EQ(error(two, {.set = {"marker.0.depth_m=-1"}}),
              "--set marker.0.depth_m=-1: marker[0].depth_m: out of range (-1), allowed: at least "
              "0, at most 10000");
    EXPECT_THAT(error(two, {.set = {"marker.depth_m=1"}}), HasSubstr("--set marker.0.key=value"));
    EXPECT_THAT(error("", {.set = {"marker=[]"}}), HasSubstr("is empty"));
    EXPECT_THAT(error("", {.set = {"marker=[1]"}}), HasSubstr("marker[0]"));
    EXPECT_THAT(error("", {.without = {"marker"}}), HasSubstr("is not in the scene"));
}

TEST_F(TableArray, ReadsTheFileOfEachTable) {
    write_text(folder / "points.csv", "12345");
    const Scene scene = load(two + "[[marker]]\ncsv = \"points.csv\"\n");
    EXPECT_EQ(scene.find<Markers>()->back().content, 5.0);
    EXPECT_EQ(scene.find<Markers>()->front().content, 0.0);
    EXPECT_THAT(error(two + "[[marker]]\ncsv = \"none.csv\"\n"),
                AllOf(HasSubstr("scene.toml:10: marker[2].csv"), HasSubstr("no such file")));
}

TEST_F(TableArray, ReadsBackWhatItWrites) {
    const Scene scene = load(two);
    const std::string text = to_toml(scene);
    EXPECT_THAT(text, HasSubstr("\n[[marker]]  # a marker of the test\nname = \"a\""));
    EXPECT_EQ(to_toml(load(text)), text);
    EXPECT_EQ(names(load(text)), names(scene));

    // A template is the scene, too.
    const fs::path made = folder / "scene" / "scene.toml";
    fs::create_directories(made.parent_path());
    load(two);
    write_text(made, scene_template((folder / "scene.toml").string(), effects()));
    EXPECT_EQ(names(load_scene({.scene = made.string()}, effects())), names(scene));
}

TEST_F(TableArray, IsComparedTableByTable) {
    const Scene one = load(two), other = load(two, {.set = {"marker.1.depth_m=3"}}),
                three = load(two + "[[marker]]\n");
    const auto found = scene_differences(one, other, effects());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].path, "marker[1].depth_m");
    const auto digits = [&](const char* change) {
        const SceneDifference one_of =
            scene_differences(one, load(two, {.set = {change}}), effects())[0];
        return one_of.first + " " + one_of.second;
    };
    EXPECT_EQ(digits("marker.1.depth_m=1234.56789012345"), "2000 1234.57");
    EXPECT_EQ(digits("marker.1.depth_m=2000.0000125"), "2000 2000.00001"); // where they differ
    const auto longer = scene_differences(one, three, effects());
    ASSERT_EQ(longer.size(), 1u);
    EXPECT_EQ(longer[0].path, "marker[2]");

    const auto values = [](const Scene& scene) { return archive::scene_values(to_toml(scene)); };
    EXPECT_EQ(values(one).at("marker.1.depth_m"), "2000.0");
    EXPECT_EQ(archive::scene_difference(values(one), values(other))->parameter, "marker.1.depth_m");
    EXPECT_TRUE(archive::scene_difference(values(one), values(three)));
    EXPECT_FALSE(archive::scene_difference(values(one), values(load(two))));
}

TEST_F(TableArray, IsInReferenceAndSchema) {
    EXPECT_THAT(parameter_reference(effects()),
                HasSubstr("\n[[marker]] (effect): a marker of the test\n    name = "));
    const auto schema = nlohmann::json::parse(scene_schema(effects()))["properties"]["marker"];
    EXPECT_EQ(schema["type"], "array");
    EXPECT_EQ(schema["minItems"], 1);
    EXPECT_EQ(schema["items"]["properties"]["depth_m"]["maximum"], 1e4);
    EXPECT_TRUE(schema["items"]["properties"].contains("csv"));
}

} // namespace
} // namespace listric::table_array_test
