// Material files: what is read, what is refused and how, and that scenes take their defaults from
// them in the right order.

#include "apps/scene/parameters/material_file.hpp"
#include "tests/message_of.hpp"

#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/sedimentation.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace listric::material_file_test {

using namespace dem;
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string rock_text = "description = 'a rock'\n"
                              "[material]\n"
                              "normal_stiffness_pa = 2e10\n"
                              "shear_stiffness_pa = 1e10\n"
                              "friction = 0.7\n";
const std::string bonds_text = "[bonds]\n"
                               "tensile_strength_pa = 1e5\n"
                               "tensile_strength_sd_pa = 2e4\n"
                               "shear_strength_pa = 3e6\n"
                               "shear_strength_sd_pa = 4e5\n";
const std::string scene_text = "[hanging_wall]\n"
                               "[detachment]\n"
                               "segments = [{arc = {radius_m = 15e3}}]\n";

class MaterialFileTest : public testing::Test {
protected:
    MaterialFileTest() {
        fs::create_directories(folder / "rocks");
        unsetenv("LISTRIC_MATERIALS");
    }
    ~MaterialFileTest() override {
        fs::remove_all(folder);
        unsetenv("LISTRIC_MATERIALS");
    }

    std::string write(const std::string& text, const std::string& name) const {
        std::ofstream(folder / name, std::ios::binary) << text;
        return (folder / name).string();
    }

    Scene load(const std::string& text, const std::vector<std::string>& set = {}) const {
        return load_scene({.scene = write(text, "scene.toml"), .set = set});
    }

    template <class Call> std::string error_of(Call&& call) const {
        return support::scene_message_of(call, folder);
    }

    std::string error(const std::string& rock) const {
        return error_of([&] { load_material(write(rock, "rock.toml")); });
    }
    std::string scene_error(const std::string& text,
                            const std::vector<std::string>& set = {}) const {
        return error_of([&] { load(text, set); });
    }

    const fs::path folder =
        fs::temp_directory_path() /
        fmt::format("listric_material_file_test_{}",
                    testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(MaterialFileTest, ShippedMaterials) {
    EXPECT_THAT(materials.names(),
                ElementsAre("mat18-b", "mat18-b-calibrated", "mat18-w", "mat18-w-calibrated",
                            "mat18-w-frictional", "mica", "mud", "salt", "sand", "sandbox-sand",
                            "sandbox-sand-36", "sediment", "shale", "silt"));
    for (const std::string& name : materials.names()) {
        const RockMaterial rock = load_material(name);
        EXPECT_EQ(rock.name, name);
        EXPECT_FALSE(rock.description.empty());
        EXPECT_EQ(rock.bonds.has_value(), name.starts_with("mat18-b")) << name;
        EXPECT_EQ(rock.material.bondable, rock.bonds.has_value());
    }
    const RockMaterial strong = load_material("mat18-b-calibrated");
    EXPECT_EQ(strong.material.friction, 2.8);
    EXPECT_EQ(strong.bonds->shear_mean, 2e9);
    EXPECT_EQ(load_material("mat18-w-calibrated").material.friction, 0.5);
    // The scenes' weakened rock: Table 1's but for its friction.
    const Material scenes = load_material("mat18-w-frictional").material;
    const Material table = load_material("mat18-w").material;
    EXPECT_EQ(scenes.friction, 0.2);
    EXPECT_EQ(scenes.normal_stiffness, table.normal_stiffness);
    EXPECT_EQ(scenes.shear_stiffness, table.shear_stiffness);
}

TEST_F(MaterialFileTest, TheDefaultsOfTheProgramAreTheShippedScenesRock) {
    const auto expect_same = [](const Material& a, const Material& b) {
        EXPECT_EQ(a.normal_stiffness, b.normal_stiffness);
        EXPECT_EQ(a.shear_stiffness, b.shear_stiffness);
        EXPECT_EQ(a.friction, b.friction);
    };
    const RockMaterial rock = load_material("mat18-b");
    expect_same(rock.material, Material{});
    expect_same(load_material("mat18-w-frictional").material, FaultWeakeningParameters{}.material);
    expect_same(load_material("sediment").material, SedimentationParameters{}.material);
    EXPECT_EQ(rock.bonds->tensile_mean, BondStrength{}.tensile_mean);
    EXPECT_EQ(rock.bonds->tensile_deviation, BondStrength{}.tensile_deviation);
    EXPECT_EQ(rock.bonds->shear_mean, BondStrength{}.shear_mean);
    EXPECT_EQ(rock.bonds->shear_deviation, BondStrength{}.shear_deviation);
    EXPECT_EQ(rock.bonds->reading, BondStrength{}.reading);
}

TEST_F(MaterialFileTest, WhatIsReadAndWritten) {
    const RockMaterial rock =
        load_material(write(rock_text + bonds_text + "strength_is = 'force'\n", "rock.toml"));
    EXPECT_EQ(rock.name, "rock");
    EXPECT_EQ(rock.description, "a rock");
    EXPECT_EQ(rock.material.normal_stiffness, 2e10);
    EXPECT_EQ(rock.material.shear_stiffness, 1e10);
    EXPECT_EQ(rock.material.friction, 0.7);
    EXPECT_TRUE(rock.material.bondable);
    EXPECT_EQ(rock.bonds->tensile_mean, 1e5);
    EXPECT_EQ(rock.bonds->shear_deviation, 4e5);
    EXPECT_EQ(rock.bonds->reading, StrengthReading::force);
    EXPECT_EQ(to_toml(load_material(write(to_toml(rock), "again.toml"))), to_toml(rock));
    const RockMaterial sand = load_material(write(rock_text, "sand.toml"));
    EXPECT_FALSE(sand.bonds);
    EXPECT_FALSE(sand.material.bondable);
    EXPECT_EQ(sand.material.rolling_friction, 0.0);
    const RockMaterial rolls =
        load_material(write(rock_text + "rolling_friction = 0.1\n", "rolls.toml"));
    EXPECT_EQ(rolls.material.rolling_friction, 0.1);
    EXPECT_EQ(load_material(write(to_toml(rolls), "again.toml")).material.rolling_friction, 0.1);
    EXPECT_FALSE(load_material(write(to_toml(sand), "again.toml")).bonds);
}

TEST_F(MaterialFileTest, MissingMicropropertiesAreNamed) {
    EXPECT_EQ(error("description = 'x'\n"),
              "rock.toml: needs [material], the microproperties of its discs");
    EXPECT_EQ(error("# only a comment\n"),
              "rock.toml: is empty; a material has at least [material]");
    EXPECT_EQ(error("[material]\nnormal_stiffness_pa = 1e10\nfriction = 0.5\n"),
              "rock.toml:1: material: needs shear_stiffness_pa (shear stiffness of one disc; "
              "at least 1000, at most 1e15)");
    EXPECT_EQ(error(rock_text + "[bonds]\ntensile_strength_pa = 1e5\n"),
              "rock.toml:6: bonds: needs tensile_strength_sd_pa (standard deviation of the tensile "
              "strength; at least 0, at most 1e12)");
}

TEST_F(MaterialFileTest, WrongValuesAreNamed) {
    EXPECT_EQ(error(rock_text + "frction = 0.3\n"),
              "rock.toml:6: material.frction: unknown key, did you mean friction?");
    EXPECT_EQ(error(rock_text + "[bond]\n"),
              "rock.toml:6: bond: unknown table, did you mean bonds?");
    EXPECT_EQ(error("seed = 3\n" + rock_text),
              "rock.toml:1: seed: unknown key, allowed: description, material, bonds, pores");
    EXPECT_EQ(error("[material]\nnormal_stiffness_pa = -1.0\n"),
              "rock.toml:2: material.normal_stiffness_pa: out of range (-1), "
              "allowed: at least 1000, at most 1e15");
    EXPECT_EQ(
        error("[material]\nfriction = nan\n"),
        "rock.toml:2: material.friction: out of range (nan), allowed: at least 0, at most 10");
    EXPECT_EQ(error("material = 3\n"),
              "rock.toml:1: material: wrong type (integer 3), allowed: table");
    EXPECT_THAT(error("[material\n"), StartsWith("rock.toml:1:10: "));
}

TEST_F(MaterialFileTest, MissingFilesAreAnsweredWithWhatThereIs) {
    const std::string shipped = "(materials: mat18-b, mat18-b-calibrated, mat18-w, "
                                "mat18-w-calibrated, mat18-w-frictional, mica, mud, salt, "
                                "sand, sandbox-sand, sandbox-sand-36, sediment, shale, silt)";
    const auto missing = [&](const std::string& name) {
        return error_of([&] { load_material(name); });
    };
    EXPECT_EQ(missing("mat18b"), "mat18b: no such material, did you mean mat18-b? " + shipped);
    EXPECT_EQ(missing("granite"), "granite: no such material " + shipped);
    EXPECT_EQ(missing("granite.toml"), "granite.toml: no such file " + shipped);
    EXPECT_EQ(scene_error(scene_text + "[materials]\nbasement = 'mat18b'\n"),
              "scene.toml:5: materials.basement: mat18b: no such material, did you mean mat18-b? " +
                  shipped);
    EXPECT_EQ(scene_error(scene_text, {"materials.weakened=mat18w"}),
              "--set materials.weakened=mat18w: materials.weakened: mat18w: no such material, "
              "did you mean mat18-w? " +
                  shipped);
    EXPECT_EQ(scene_error(scene_text + "[materials]\nbasment = 'mat18-b'\n"),
              "scene.toml:5: materials.basment: unknown key, did you mean basement?");
    EXPECT_EQ(scene_error(scene_text + "[material]\nbasement = 'mat18-b'\n"),
              "scene.toml:5: material.basement: unknown key, allowed: normal_stiffness_pa, "
              "shear_stiffness_pa, friction, rolling_friction");
    EXPECT_EQ(scene_error(scene_text + "[materials]\nbasement = 3\n"),
              "scene.toml:5: materials.basement: wrong type (integer 3), allowed: string");
    setenv("LISTRIC_MATERIALS", "/nowhere", 1);
    EXPECT_THAT(missing("mat18-b"), StartsWith("/nowhere: materials folder cannot be read"));
}

TEST_F(MaterialFileTest, MaterialThenSceneThenSet) {
    write(rock_text + bonds_text, "rocks/rock.toml");
    const std::string materials = "[materials]\nbasement = 'rocks/rock.toml'\n";
    const Scene plain = load(scene_text + materials);
    EXPECT_EQ(plain.basement.normal_stiffness, 2e10);
    EXPECT_EQ(plain.basement.friction, 0.7);
    EXPECT_FALSE(
        make_parts(plain).bonds); // an effect is on when the scene has its table, whatever the rock
    const Scene bonded = load(scene_text + materials + "[bonds]\nshear_strength_pa = 5e6\n",
                              {"material.friction=0.9", "bonds.tensile_strength_pa=7e4"});
    EXPECT_EQ(bonded.basement.normal_stiffness, 2e10);
    EXPECT_EQ(bonded.basement.friction, 0.9);
    EXPECT_EQ(make_parts(bonded).bonds->tensile_mean, 7e4);
    EXPECT_EQ(make_parts(bonded).bonds->tensile_deviation, 2e4);
    EXPECT_EQ(make_parts(bonded).bonds->shear_mean, 5e6);
    EXPECT_EQ(load(scene_text + "[material]\nfriction = 0.2\n", {"materials.basement=mat18-b"})
                  .basement.friction,
              0.2);
}

TEST_F(MaterialFileTest, WeakenedAndSediment) {
    const std::string effects = "[gravity]\n[fault_weakening]\n[sedimentation]\n";
    const Scene scene =
        load(scene_text + effects,
             {"materials.weakened=mat18-w-calibrated",
              "materials.sediment=" + write(rock_text, "sand.toml"), "sedimentation.friction=0.4"});
    EXPECT_EQ(scene.find<FaultWeakeningParameters>()->material.normal_stiffness, 1.7e10);
    EXPECT_EQ(scene.find<FaultWeakeningParameters>()->material.friction, 0.5);
    EXPECT_EQ(scene.find<SedimentationParameters>()->material.normal_stiffness, 2e10);
    EXPECT_EQ(scene.find<SedimentationParameters>()->material.friction, 0.4);
    // Weak discs stay unbonded and sediment can be cemented, whatever the files say.
    const Scene swapped = load(scene_text + effects, {"materials.weakened=mat18-b"});
    EXPECT_FALSE(swapped.find<FaultWeakeningParameters>()->material.bondable);
    EXPECT_TRUE(swapped.find<SedimentationParameters>()->material.bondable);
}

TEST_F(MaterialFileTest, BondedScenesNeedRockWithBonds) {
    const std::string text = scene_text + "[materials]\nbasement = 'mat18-w'\n";
    EXPECT_EQ(scene_error(text), "no error");
    EXPECT_EQ(
        scene_error(text + "[bonds]\n"),
        "scene.toml:5: materials.basement: has no [bonds], but the scene does; add [bonds] to "
        "the material's file or take it out of the scene");
}

TEST_F(MaterialFileTest, WhatARunWritesNeedsNoMaterialFile) {
    write(rock_text + bonds_text, "rocks/rock.toml");
    const Scene scene = load(scene_text + "[materials]\nbasement = 'rocks/rock.toml'\n[bonds]\n");
    fs::remove(folder / "rocks/rock.toml");
    EXPECT_EQ(to_toml(load(to_toml(scene))), to_toml(scene));
    EXPECT_THAT(
        parameter_reference(program_effects()),
        AllOf(HasSubstr("\n[materials]"), HasSubstr("    weakened = \"mat18-w-frictional\"\n")));
}

} // namespace
} // namespace listric::material_file_test
