// What the drawing page asks of the program.

#include "apps/measures/basin/kinematics.hpp"
#include "apps/model/effects.hpp"
#include "apps/run/drawing.hpp"
#include "apps/scene/toml/json_document.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/reading.hpp"
#include "dem/numbers/units.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace listric::drawing_test {

using Json = nlohmann::ordered_json;

namespace {

Json document_of(const std::string& text) {
    GivenTexts given;
    given.give("/s.toml", text);
    return scene_document({.scene = "/s.toml"}, program_effects());
}

TEST(DrawnScene, ScenesComeBackFromThePageAsTheyWent) {
    for (const auto& [name, description] : list_scenes()) {
        const Json document = scene_document({.scene = name}, program_effects());
        // Through a page, whose numbers do not tell 1 from 1.0.
        const std::string text = toml_text(Json::parse(document.dump()), program_effects());
        GivenTexts given;
        given.give("/" + name + ".toml", text);
        const Scene after = load_scene({.scene = "/" + name + ".toml"}, program_effects());
        const Scene before = load_scene({.scene = name}, program_effects());
        EXPECT_EQ(to_toml(after), to_toml(before));
        EXPECT_EQ(document_of(text), document) << name;
    }
}

TEST(DrawnScene, WhatNoNumberHoldsStaysText) {
    const std::string text = "seed = 9223372036854775807\n\"odd key\" = [inf, 1979-05-27]\n"
                             "[[stage]]\ndistance_m = 1\n[[stage]]\n";
    const Json document = document_of(text);
    EXPECT_EQ(document["seed"]["toml"], "9223372036854775807");
    EXPECT_EQ(toml_text(document, program_effects()),
              "seed = 9223372036854775807\n\"odd key\" = [inf, 1979-05-27]\n\n"
              "# motion in stages: extension, pauses, shortening, one after the other\n[[stage]]\n"
              "distance_m = 1.0\n\n[[stage]]\n");
}

TEST(DrawnScene, AValueIsReadAndRefusedInTheWordsOfTheProgram) {
    const auto facts = [](const std::string& path, const std::string& text) {
        return value_facts({.scene = "lis1", .set = {path + "=" + text}}, path, program_effects());
    };
    EXPECT_EQ(facts("hanging_wall.porosity", "0.2"), (Json{{"value", 0.2}, {"fault", ""}}));
    EXPECT_EQ(facts("hanging_wall.porosty", "0.2")["fault"],
              "--set hanging_wall.porosty=0.2: hanging_wall.porosty: unknown key, did you mean "
              "porosity?");
    EXPECT_NE(facts("seed", "1.5")["fault"].get<std::string>().find("wrong type (number 1.5)"),
              std::string::npos);
}

TEST(DrawnScene, CurvesAreThoseOfInclinedShear) {
    const Json detachment = scene_document({.scene = "lis2"}, program_effects())["detachment"];
    const Scene scene = load_scene({.scene = "lis2"}, program_effects());
    const Json found = kinematics_json({{"detachment", detachment},
                                        {"extension_m", 5000.0},
                                        {"angle_deg", 30.0},
                                        {"right_m", 45e3},
                                        {"reach_m", 80e3},
                                        {"step_m", 25.0}},
                                       program_effects());
    const dem::Chain chain = dem::detachment_chain(*scene.detachment, 80e3);
    ASSERT_EQ(found["tops"].size(), 8);
    for (std::size_t k = 0; k < 8; ++k) {
        const double extension = 5000.0 * static_cast<double>(8 - k) / 8.0;
        const auto top = measures::inclined_shear_top(chain, extension, 30.0, 45e3);
        const Json& numbers = found["tops"][k];
        ASSERT_EQ(numbers.size(), 2 * top.size());
        const double unit = found["unit_m"]; // to which points are rounded
        for (std::size_t n = 0; n < top.size(); ++n) {
            EXPECT_NEAR(numbers[2 * n].get<double>() * unit, top[n].x, unit);
            EXPECT_NEAR(numbers[2 * n + 1].get<double>() * unit, top[n].y, unit);
        }
    }
    EXPECT_EQ(found["tilt"], measures::normals_tilt(chain, 5000.0));
    EXPECT_THROW(
        check_pieces({{"start_dip_deg", 60.0}, {"segments", {{{"line", {{"length_m", 5.0}}}}}}},
                     program_effects()),
        SceneError);
}

TEST(DrawnScene, AFaultIsFittedAsASceneHasIt) {
    std::string points = "x_m,depth_m\n";
    for (int k = 0; k < 10; ++k) // an arc from the vertical to the flat
        points += fmt::format("{},{}\n", 1e4 - 1e4 * std::cos(k * dem::pi / 18.0),
                              1e4 * std::sin(k * dem::pi / 18.0));
    const GivenTexts given(
        {{"/f.csv", points + "15000,10000\n20000,10000\n"},
         {"/two.csv", "x_m,depth_m\n0,0\n100,1900\n"},
         {"/s.toml", "[hanging_wall]\nlength_m = 30000.0\n[detachment]\ncsv = \"f.csv\"\n"}});
    const Json fitted = fitted_fault({{"csv", "f.csv"}, {"friction", 0.4}}, program_effects());
    EXPECT_EQ(fitted["x_m"].size(), 12);
    const Scene scene = load_scene({.scene = "/s.toml"}, program_effects());
    const Json pieces = pieces_json(*scene.detachment);
    EXPECT_EQ(fitted["segments"], pieces["segments"]);
    EXPECT_EQ(fitted["start_dip_deg"], pieces["start_dip_deg"]);
    EXPECT_LT(fitted["misfit_m"], 50.0);
    // Fewer points than a fit needs stay points.
    const Json two = fitted_fault({{"csv", "two.csv"}}, program_effects());
    EXPECT_EQ(two["depth_m"], (Json{0.0, 1900.0}));
    EXPECT_FALSE(two["fault"].get<std::string>().empty());
}

} // namespace
} // namespace listric::drawing_test
