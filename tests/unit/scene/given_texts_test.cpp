// Scenes, picks and rocks that are handed over as texts: read as files are, and refused in the same
// words.

#include "apps/model/effects.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/scene/toml/shelf.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/reading.hpp"
#include "tests/message_of.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <unistd.h>

namespace listric::given_texts_test {

namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

using Texts = std::map<std::string, std::string>; ///< by name

const Texts good{
    {"own.toml",
     "name = \"own\"\n[materials]\nbasement = \"./rock.toml\"\n[hanging_wall]\nlength_m = 9e3\n"
     "[detachment]\ncsv = \"picks.csv\"\n[observed]\nhorizons = \"horizons.csv\"\n"},
    {"picks.csv", "x_m,depth_m\n0,0\n500,1100\n1200,2000\n2500,2700\n5000,3000\n15000,3000\n"},
    {"horizons.csv", "name,x_m,depth_m\nH1,1000,100\nH1,4000,120\n"},
    {"rock.toml",
     "[material]\nnormal_stiffness_pa = 17e9\nshear_stiffness_pa = 17e9\nfriction = 0.3\n"
     "[bonds]\ntensile_strength_pa = 30e6\ntensile_strength_sd_pa = 1e6\nshear_strength_pa = 60e6\n"
     "shear_strength_sd_pa = 2e6\n"},
    {"fault.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"><path id=\"f\" "
                  "d=\"M60,40C130,250 230,340 320,340H710\"/></svg>"},
};

Texts with(const std::string& name, const std::string& text) {
    Texts texts = good;
    texts[name] = text;
    return texts;
}

/// What is read of a scene own.toml in a folder, or why it is refused, without the folder's name.
std::string outcome(const fs::path& folder) {
    std::string text;
    try {
        const Scene scene =
            load_scene({.scene = (folder / "own.toml").string()}, program_effects());
        text = to_toml(scene);
        for (const std::string& warning : scene.warnings)
            text += warning + "\n";
        for (const fs::path& file : scene.files)
            text += file.string() + "\n";
    } catch (const SceneError& error) {
        text = error.what();
    }
    for (std::size_t at; (at = text.find(folder.string())) != text.npos;)
        text.replace(at, folder.string().size(), "FOLDER");
    return text;
}

class GivenTextsTest : public testing::Test {
protected:
    fs::path folder = fs::path(testing::TempDir()) / fmt::format("listric-given-{}", getpid());
    const fs::path nowhere = "/nowhere/at/all";
    ~GivenTextsTest() override { fs::remove_all(folder); }

    /// Outcome of texts, which must be that of files.
    std::string outcome_of(const Texts& texts) {
        fs::remove_all(folder);
        fs::create_directories(folder);
        Texts given;
        for (const auto& [name, text] : texts) {
            std::ofstream(folder / name) << text;
            given[(nowhere / name).string()] = text;
        }
        const GivenTexts at_hand(given);
        const std::string outcome = given_texts_test::outcome(nowhere);
        EXPECT_EQ(outcome, given_texts_test::outcome(folder));
        return outcome;
    }
};

} // namespace

TEST_F(GivenTextsTest, AreReadAsFiles) {
    EXPECT_THAT(outcome_of(good), HasSubstr("[detachment]"));
    const std::string svg = "name = \"own\"\n[hanging_wall]\nlength_m = 9e3\n[detachment]\nsvg = "
                            "\"fault.svg\"\nsvg_path = \"f\"\nsvg_points = [[60, 40, 0, 0], [710, "
                            "340, 13000, 3000]]\n";
    EXPECT_THAT(outcome_of(with("own.toml", svg)), HasSubstr("[detachment]"));
}

TEST_F(GivenTextsTest, AreRefusedInTheSameWords) {
    EXPECT_THAT(outcome_of(with("own.toml", "name = 1\n")), HasSubstr("FOLDER/own.toml:1"));
    EXPECT_THAT(outcome_of(with("own.toml", "")), HasSubstr("is empty"));
    EXPECT_THAT(outcome_of(with("own.toml", std::string("a\0b", 3))), HasSubstr("NUL byte"));
    EXPECT_THAT(outcome_of(with("picks.csv", "x_m,depth_m\n0,zero\n")),
                HasSubstr("FOLDER/picks.csv:2"));
    EXPECT_THAT(outcome_of(with("rock.toml", "[material]\nweight = 1\n")),
                HasSubstr("FOLDER/./rock.toml:2"));
    const std::string svg =
        "[detachment]\nsvg = \"fault.svg\"\nsvg_path = \"g\"\nsvg_points = [[60, 40, 0, 0], "
        "[710, 340, 13000, 3000]]\n";
    Texts texts = with("own.toml", "name = \"own\"\n" + svg);
    EXPECT_THAT(outcome_of(texts), HasSubstr("FOLDER/fault.svg"));
    texts["fault.svg"] = "\x1f\x8b compressed";
    EXPECT_THAT(outcome_of(texts), HasSubstr("compressed"));
    texts["fault.svg"] = "<svg><";
    EXPECT_THAT(outcome_of(texts), HasSubstr("cannot be read as SVG"));
    texts = good;
    texts.erase("picks.csv");
    EXPECT_THAT(outcome_of(texts), HasSubstr("no such file"));
    texts.erase("own.toml");
    EXPECT_THAT(outcome_of(texts), HasSubstr("no such file"));
}

TEST_F(GivenTextsTest, AreAShelf) {
    const GivenTexts at_hand({{(materials.path() / "moonstone.toml").string(), "[material]"}});
    EXPECT_THAT(materials.names(), ElementsAre("moonstone"));
    EXPECT_EQ(materials.find("moonstone"), materials.path() / "moonstone.toml");
}

TEST_F(GivenTextsTest, AreGoneWithTheirHolder) {
    const fs::path path = nowhere / "a.txt";
    {
        const GivenTexts outer({{path.string(), "outer"}});
        {
            const GivenTexts inner({{path.string(), "inner"}});
            EXPECT_EQ(read_text(nowhere / "b/../a.txt"), "inner");
        }
        EXPECT_EQ(first_bytes(path, 3), "out");
    }
    EXPECT_FALSE(is_file(path));
    EXPECT_THAT(support::message_of<StorageError>([&] { read_text(path); }),
                HasSubstr("No such file"));
}

} // namespace listric::given_texts_test
