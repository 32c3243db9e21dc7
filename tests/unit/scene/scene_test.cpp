#include "apps/model/effects.hpp"
#include "apps/model/effects/elastic_base_parameters.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/parameters/accuracy.hpp"
#include "apps/scene/toml/tables.hpp"
#include "apps/support/words/spelling.hpp"
#include "dem/events/bond_healing.hpp"
#include "dem/events/compaction.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/sedimentation.hpp"
#include "dem/numbers/units.hpp"
#include "tests/message_of.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

namespace listric::scene_test {

using namespace dem;
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A scene without effects, as short as scenes can be.
const std::string minimal = "[hanging_wall]\n"
                            "[detachment]\n"
                            "segments = [{arc = {radius_m = 15e3}}, {line = {length_m = 1e5}}]\n";

class SceneTest : public testing::Test {
protected:
    SceneTest() {
        fs::create_directories(folder);
        unsetenv("LISTRIC_SCENES");
    }
    ~SceneTest() override {
        fs::remove_all(folder);
        unsetenv("LISTRIC_SCENES");
    }

    std::string write(const std::string& text, const std::string& name = "scene.toml") const {
        std::ofstream(folder / name, std::ios::binary) << text;
        return (folder / name).string();
    }

    Scene load(const std::string& text, SceneRequest request = {}) const {
        request.scene = write(text);
        return load_scene(request);
    }

    Scene load_with(const std::vector<std::string>& set, const std::string& text = minimal) const {
        return load(text, {.set = set});
    }

    static std::string error_of(const SceneRequest& request) {
        return support::scene_message_of([&] { load_scene(request); });
    }

    /// The message without the folder: "scene.toml:3: ...".
    std::string error(const std::string& text, SceneRequest request = {}) const {
        request.scene = write(text);
        const std::string message = error_of(request);
        const std::string prefix = folder.string() + "/";
        return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
    }

    std::string set_error(const std::string& assignment) const {
        return error_of({.scene = "lis1", .set = {assignment}});
    }

    static std::string shipped() {
        std::string names;
        for (const auto& [name, description] : list_scenes())
            names += (names.empty() ? "" : ", ") + name;
        return names;
    }

    const fs::path folder =
        fs::temp_directory_path() /
        fmt::format("listric_scene_test_{}",
                    testing::UnitTest::GetInstance()->current_test_info()->name());
};

/// Everything that a file says about a scene, numbers to the last bit.
struct Bits {
    const void* object;

    static std::string of(double x) { return fmt::format("{:x}", std::bit_cast<std::uint64_t>(x)); }
    static std::string of(const std::optional<double>& x) { return x ? of(*x) : "none"; }

    std::string operator()(const Place<double>& x) const { return of(x.get(object)); }
    std::string operator()(const Place<std::optional<double>>& x) const {
        return of(x.get(object));
    }
    std::string operator()(const Place<int>& x) const { return std::to_string(x.get(object)); }
    std::string operator()(const Place<std::uint64_t>& x) const {
        return std::to_string(x.get(object));
    }
    std::string operator()(const Place<bool>& x) const { return std::to_string(x.get(object)); }
    std::string operator()(const Place<std::string>& x) const { return x.get(object); }
    std::string operator()(const Choice& x) const { return std::string(x.get(object, x.names)); }
    std::string operator()(const Place<std::vector<double>>& x) const {
        std::string items;
        for (const double item : x.get(object))
            items += of(item) + " ";
        return items;
    }
    std::string operator()(const Place<std::vector<TargetStage>>& x) const {
        std::string items;
        for (const TargetStage& stage : x.get(object)) {
            items += "at " + of(stage.time) + ": ";
            for (const Point& p : stage.points)
                items += of(p.x) + " " + of(p.y) + " ";
        }
        return items;
    }
    std::string operator()(const Place<std::vector<Point>>& x) const {
        std::string items;
        for (const Point& p : x.get(object))
            items += of(p.x) + " " + of(p.y) + " ";
        return items;
    }
    std::string operator()(const Place<std::vector<std::array<double, 4>>>& x) const {
        std::string items;
        for (const auto& four : x.get(object))
            for (const double value : four)
                items += of(value) + " ";
        return items;
    }
    std::string operator()(const Place<std::vector<PickedLine>>& x) const {
        std::string items;
        for (const PickedLine& line : x.get(object)) {
            items += line.name + " " + of(line.age) + ": ";
            for (std::size_t k = 0; k < line.x.size(); ++k)
                items += of(line.x[k]) + " " + of(line.depth[k]) + " ";
        }
        return items;
    }
    std::string operator()(const Place<std::vector<fem::Layer>>& x) const {
        std::string items;
        for (const fem::Layer& layer : x.get(object))
            for (const double value : {layer.top_depth, layer.young_modulus, layer.poisson_ratio,
                                       layer.density, layer.viscosity.value_or(0.0)})
                items += of(value) + " ";
        return items;
    }
    std::string operator()(const Place<std::vector<DetachmentSegment>>& x) const {
        std::string items;
        for (const DetachmentSegment& s : x.get(object))
            items += fmt::format("{} {} {} {} {} ", static_cast<int>(s.kind), of(s.radius),
                                 of(s.end_dip), of(s.length), of(s.start_dip));
        return items;
    }
};

std::vector<SceneTable> all_tables() { return scene_tables(program_effects()); }

std::string bits(const Scene& scene) {
    std::string lines;
    const auto add = [&](const std::vector<Parameter>& parameters, const void* object) {
        for (const Parameter& parameter : parameters)
            lines +=
                fmt::format("{} = {}\n", parameter.key, std::visit(Bits{object}, parameter.value));
    };
    add(top_level(), static_cast<const Heading*>(&scene));
    for (const SceneTable& table : all_tables()) {
        for (std::size_t item = 0; item < table.count(scene); ++item) {
            lines += table.heading() + "\n";
            add(table.parameters, table.item(scene, item));
        }
    }
    return lines;
}

std::vector<std::string> effects(const Scene& scene) { return effect_names(scene); }

// ------------------------------------------------------------------------------------ reading

TEST_F(SceneTest, Lis1IsThePapersFirstExperiment) {
    const Scene scene = load_scene({.scene = "lis1"});
    EXPECT_EQ(scene.name, "lis1");
    EXPECT_EQ(scene.description,
              "LIS1: 90-degree listric detachment, 10 km of extension [paper, experiment I]");
    EXPECT_EQ(scene.accuracy, "standard");
    EXPECT_EQ(scene.seed, 1u);
    EXPECT_EQ(scene.hanging_wall.length, 40e3);
    EXPECT_EQ(scene.hanging_wall.thickness, 15e3);
    EXPECT_EQ(scene.hanging_wall.mean_radius, 93.1);
    EXPECT_EQ(scene.detachment->start_dip, 90.0);
    ASSERT_EQ(scene.detachment->segments.size(), 2u);
    EXPECT_EQ(scene.detachment->segments[0].kind, DetachmentSegment::Kind::arc);
    EXPECT_EQ(scene.detachment->segments[0].radius, 15e3);
    EXPECT_EQ(scene.detachment->segments[0].end_dip, 0.0);
    EXPECT_EQ(scene.detachment->segments[1].kind, DetachmentSegment::Kind::line);
    EXPECT_EQ(scene.detachment->segments[1].length, 60e3);
    EXPECT_FALSE(scene.detachment->segments[1].start_dip);
    EXPECT_THAT(effects(scene), ElementsAre("gravity", "bonds", "fault_weakening", "bond_healing",
                                            "sedimentation", "compaction"));
    EXPECT_EQ(scene.find<CompactionParameters>()->coefficient, 4e-4);
}

TEST_F(SceneTest, WhatAFileLeavesOutHasItsDefault) {
    const Scene scene = load(minimal);
    Scene expected;
    expected.name = "scene"; // the file's
    expected.detachment = scene.detachment;
    EXPECT_EQ(bits(scene), bits(expected));
    EXPECT_TRUE(effects(scene).empty());
}

TEST_F(SceneTest, EveryTypeOfValueIsRead) {
    const Scene scene = load("description = 'd'\naccuracy = 'fine'\nseed = 7\n" + minimal +
                             "friction = 1\n"
                             "[output]\nfigures_at_m = [1000, 2500.5]\n"
                             "[bonds]\nstrength_is = 'force'\n"
                             "[fault_weakening]\nangles = 24\n"
                             "[bond_healing]\nmeasure = 'slip_and_opening'\n"
                             "[sedimentation]\nlevel_m = -200\n"
                             "[compaction]\ncoefficient_per_km = 0.27\n");
    EXPECT_EQ(scene.description, "d");
    EXPECT_EQ(scene.accuracy, "fine");
    EXPECT_EQ(scene.seed, 7u);
    EXPECT_EQ(scene.detachment->friction, 1.0);
    EXPECT_THAT(scene.output.figures, ElementsAre(1000.0, 2500.5));
    EXPECT_EQ(make_parts(scene).bonds->reading, StrengthReading::force);
    EXPECT_EQ(scene.find<FaultWeakeningParameters>()->angles, 24);
    EXPECT_EQ(scene.find<BondHealingParameters>()->measure, HealingMeasure::slip_and_opening);
    EXPECT_EQ(scene.find<SedimentationParameters>()->level, -200.0);
    EXPECT_EQ(scene.find<CompactionParameters>()->coefficient, 0.27e-3);
}

TEST_F(SceneTest, AccuracyLevelsSetTheRadius) {
    const std::vector<std::pair<std::string, double>> levels{
        {"draft", 186.2}, {"standard", 93.1}, {"fine", 46.55}, {"sandbox", 18.62}};
    for (const auto& [level, radius] : levels) {
        const Scene scene = load_scene({.scene = "lis1", .accuracy = level});
        EXPECT_EQ(scene.accuracy, level);
        EXPECT_EQ(scene.hanging_wall.mean_radius, radius);
        EXPECT_EQ(scene.cycle.softness, accuracy_level(level).softness);
        EXPECT_EQ(scene.extension.ramp, accuracy_level(level).ramp);
    }
}

TEST_F(SceneTest, KeepsAtAnotherLevelWhatIsNotItsOwnLevels) {
    const AccuracyLevel &draft = accuracy_level("draft"), &fine = accuracy_level("fine");
    const Scene moved = at_level(load_scene({.scene = "lis1", .accuracy = "draft"}), fine);
    EXPECT_EQ(moved.hanging_wall.mean_radius, fine.mean_radius);
    EXPECT_EQ(moved.cycle.softness, fine.softness);
    EXPECT_EQ(moved.extension.ramp, fine.ramp);
    const Scene kept = at_level(
        load_scene({.scene = "lis1", .set = {"cycle.softness=2"}, .accuracy = "standard"}), draft);
    EXPECT_EQ(kept.cycle.softness, 2.0);
    EXPECT_EQ(kept.extension.speed, draft.speed);
}

TEST_F(SceneTest, DefaultThenAccuracyThenFileThenSet) {
    const std::string with_radius = std::string(minimal).insert(15, "mean_radius_m = 120.0\n");
    const auto radius = [](const Scene& scene) { return scene.hanging_wall.mean_radius; };
    EXPECT_EQ(radius(load(minimal)), 93.1);
    EXPECT_EQ(radius(load("accuracy = 'draft'\n" + minimal)), 186.2);
    EXPECT_EQ(radius(load("accuracy = 'draft'\n" + with_radius)), 120.0);
    EXPECT_EQ(radius(load(with_radius, {.accuracy = "draft"})), 120.0);
    EXPECT_EQ(radius(load_with({"hanging_wall.mean_radius_m=150"}, with_radius)), 150.0);
    EXPECT_EQ(radius(load_with({"accuracy=fine"})), 46.55);
}

TEST_F(SceneTest, AccuracyAndSeedOfTheCallWin) {
    const Scene scene = load("accuracy = 'draft'\nseed = 4\n" + minimal,
                             {.set = {"seed=5"}, .accuracy = "fine", .seed = 6});
    EXPECT_EQ(scene.accuracy, "fine");
    EXPECT_EQ(scene.hanging_wall.mean_radius, 46.55);
    EXPECT_EQ(scene.seed, 6u);
}

TEST_F(SceneTest, SetChangesOneParameterAndKeepsTheOthers) {
    const Scene scene = load_with({"cycle.damping=0.4", "cycle = {skin = 0.2}", "seed=3"},
                                  minimal + "[cycle]\ndamping = 0.5\nskin = 0.3\n");
    EXPECT_EQ(scene.cycle.damping, 0.4);
    EXPECT_EQ(scene.cycle.skin, 0.2);
    EXPECT_EQ(scene.seed, 3u);
}

TEST_F(SceneTest, SoftnessDividesStiffnessButOfWeakRockAndBase) {
    const std::string rocks = minimal + "[sedimentation]\n[fault_weakening]\n";
    const ModelParts stiff = make_parts(load(rocks));
    const ModelParts soft = make_parts(load(rocks + "[cycle]\nsoftness = 4\n"));
    for (const MaterialIndex m : {basement, sediment}) {
        EXPECT_EQ(4.0 * soft.materials[m].normal_stiffness, stiff.materials[m].normal_stiffness);
        EXPECT_EQ(4.0 * soft.materials[m].shear_stiffness, stiff.materials[m].shear_stiffness);
        EXPECT_EQ(soft.materials[m].friction, stiff.materials[m].friction);
    }
    EXPECT_EQ(soft.materials[weak].normal_stiffness, stiff.materials[weak].normal_stiffness);
    EXPECT_EQ(soft.base.material.normal_stiffness, stiff.base.material.normal_stiffness);
}

TEST_F(SceneTest, SoftRockIsTheStiffestRock) { // else the time step would not grow
    for (const char* rocks :
         {"", "[sedimentation]\n", "[fault_weakening]\nnormal_stiffness_pa = 1.7e11\n"}) {
        const ModelParts soft = make_parts(load(minimal + rocks + "[cycle]\nsoftness = 4\n"));
        for (const Material& material : soft.materials) {
            EXPECT_LE(material.normal_stiffness, soft.materials[basement].normal_stiffness);
            EXPECT_LE(material.shear_stiffness, soft.materials[basement].shear_stiffness);
        }
    }
}

TEST_F(SceneTest, DiscsThatOverlapTooMuchAreWarnedOf) {
    const std::string heavy = minimal + "[gravity]\n[cycle]\nsoftness = ";
    EXPECT_THAT(load(heavy + "2\n").warnings, testing::IsEmpty());
    EXPECT_THAT(
        load(heavy + "16\n").warnings,
        ElementsAre(HasSubstr("cycle.softness = 16: discs overlap by 12.0 % of their radius at "
                              "15 km depth; 2.6 keeps that below 2 %")));
}

TEST_F(SceneTest, TheLastSetWins) { EXPECT_EQ(load_with({"seed=3", "seed=4"}).seed, 4u); }

TEST_F(SceneTest, SetSwitchesAnEffectOn) {
    const auto gravity = [&](const char* set) {
        return make_parts(load_with({set})).physics.gravity;
    };
    EXPECT_EQ(gravity("gravity.acceleration_m_per_s2=1.62"), 1.62);
    EXPECT_EQ(gravity("gravity={}"), 9.81);
}

TEST_F(SceneTest, SetReplacesAList) {
    const Scene scene = load_with({"detachment.segments=[{line = {length_m = 3e3}}, "
                                   "{arc = {radius_m = 12e3}}]",
                                   "output.figures_at_m=[]"});
    EXPECT_EQ(scene.detachment->segments.size(), 2u);
    EXPECT_EQ(scene.detachment->segments[1].radius, 12e3);
    EXPECT_TRUE(scene.output.figures.empty());
}

TEST_F(SceneTest, AValueThatIsNotTomlIsAString) {
    const std::string quote = R"(a "quoted" \ text, 5 km)";
    EXPECT_EQ(load_with({"description=" + quote}).description, quote);
    EXPECT_EQ(load_with({"description=a=b"}).description, "a=b");
    EXPECT_EQ(load_with({"description='in quotes'"}).description, "in quotes");
    EXPECT_EQ(load_with({"description="}).description, "");
    EXPECT_EQ(load_with({"description=two\nlines"}).description, "two\nlines");
    EXPECT_EQ(load_with({"accuracy=fine"}).accuracy, "fine");
}

TEST_F(SceneTest, WithoutTakesAnEffectOut) {
    const Scene scene =
        load_scene({.scene = "lis1", .without = {"gravity", "bonds", "bond_healing", "gravity"}});
    EXPECT_THAT(effects(scene), ElementsAre("fault_weakening", "sedimentation", "compaction"));
}

// ---------------------------------------------------------------------------- refused parameters

TEST_F(SceneTest, UnknownNamesAreAnsweredWithTheOnesMeant) {
    EXPECT_EQ(error(minimal + "[cycle]\ndampping = 0.5\n"),
              "scene.toml:5: cycle.dampping: unknown key, did you mean damping?");
    EXPECT_EQ(error(minimal + "[gravty]\n"),
              "scene.toml:4: gravty: unknown table, did you mean gravity?");
    EXPECT_EQ(error("sede = 1\n" + minimal), "scene.toml:1: sede: unknown key, did you mean seed?");
    EXPECT_EQ(error(minimal + "[gravity]\nacceleration = 9.81\n"),
              "scene.toml:5: gravity.acceleration: unknown key, "
              "did you mean acceleration_m_per_s2?");
    EXPECT_EQ(error(minimal + "[cycle]\nDamping = 0.5\n"),
              "scene.toml:5: cycle.Damping: unknown key, did you mean damping?");
    EXPECT_EQ(error(minimal + "[energy]\ndamping = true\n"),
              "scene.toml:5: energy.damping: unknown key, none is allowed");
    EXPECT_EQ(set_error("cycle.skni=0.2"),
              "--set cycle.skni=0.2: cycle.skni: unknown key, did you mean skin?");
    EXPECT_EQ(set_error("hangingwall.length_m=4e4"),
              "--set hangingwall.length_m=4e4: hangingwall: unknown table, "
              "did you mean hanging_wall?");
}

TEST_F(SceneTest, AParameterWithoutItsTableIsRecognised) {
    EXPECT_EQ(set_error("damping=0.2"),
              "--set damping=0.2: damping: unknown key, did you mean cycle.damping?");
    EXPECT_THAT(set_error("strain_rate_per_s=1e-14"),
                EndsWith("did you mean fault_weakening.strain_rate_per_s or "
                         "bond_healing.strain_rate_per_s?"));
}

TEST_F(SceneTest, ASwitchIsTrueOrFalse) {
    EXPECT_THAT(
        to_toml(load(minimal + "[gravity]\n[bonds]\n[fault_weakening]\nwhole_domain = true\n")),
        HasSubstr("\nwhole_domain = true "));
    EXPECT_EQ(set_error("fault_weakening.whole_domain=1"),
              "--set fault_weakening.whole_domain=1: fault_weakening.whole_domain: wrong type "
              "(integer 1), "
              "allowed: true or false");
}

TEST_F(SceneTest, AFormerKeyIsAnsweredWithItsSuccessor) {
    EXPECT_EQ(set_error("fault_weakening.strained_width=0.3"),
              "--set fault_weakening.strained_width=0.3: fault_weakening.strained_width: is no key "
              "any more, use least_slip_m, the slip of a fault itself");
}

TEST_F(SceneTest, AFormerKeyIsPassedOverWhereItSaysWhatIsDone) {
    const auto written = [](const std::vector<std::string>& set) {
        return to_toml(load_scene({.scene = "lis1-elastic", .set = set}));
    };
    EXPECT_EQ(written({"elastic_base.scheme=modal"}), written({}));
    EXPECT_EQ(error(minimal + "[gravity]\n[elastic_base]\nscheme = 'lumped'\n"),
              "scene.toml:6: elastic_base.scheme: is no key any more, and \"lumped\" is gone, "
              "allowed: \"modal\", which is done without it; leave it out");
    EXPECT_THAT(set_error("elastic_base.scheme=1"), HasSubstr("allowed: \"modal\""));
}

TEST_F(SceneTest, NamesLikeNoOtherAreAnsweredWithAllNames) {
    EXPECT_EQ(error(minimal + "[cycle]\ncolour = 'red'\n"),
              "scene.toml:5: cycle.colour: unknown key, allowed: damping, averaging_time_s, "
              "time_step_safety, inertial_mass_floor, skin, softness");
    EXPECT_THAT(
        error(minimal + "[magnetism]\n"),
        AllOf(StartsWith("scene.toml:4: magnetism: unknown table, allowed: name, description, "),
              HasSubstr("hanging_wall, detachment"),
              EndsWith("compaction, bed, heat, energy, elastic_base, lower_crust_thinning, "
                       "basin_water, footwall_erosion, base_motion, stage")));
}

TEST_F(SceneTest, FlexureIsAPlanOfItsOwn) {
    EXPECT_EQ(error(minimal + "[flexure]\n"),
              "scene.toml:4: flexure: is of a plan of its own, which `listric flexure` takes");
}

TEST_F(SceneTest, TypesAreChecked) {
    EXPECT_EQ(error("seed = 1.0\n" + minimal),
              "scene.toml:1: seed: wrong type (number 1.0), allowed: integer");
    EXPECT_EQ(error("seed = 'x'\n" + minimal),
              "scene.toml:1: seed: wrong type (string \"x\"), allowed: integer");
    EXPECT_EQ(error("description = 3\n" + minimal),
              "scene.toml:1: description: wrong type (integer 3), allowed: string");
    EXPECT_EQ(error("gravity = true\n" + minimal),
              "scene.toml:1: gravity: wrong type (boolean true), allowed: table");
    EXPECT_EQ(error(minimal + "[[gravity]]\n"),
              "scene.toml:4: gravity: wrong type (array), allowed: table");
    EXPECT_EQ(error(minimal + "friction = '0.5'\n"),
              "scene.toml:4: detachment.friction: wrong type (string \"0.5\"), allowed: number; "
              "write friction = 0.5");
    EXPECT_EQ(error(minimal + "[fault_weakening]\nangles = 12.0\n"),
              "scene.toml:5: fault_weakening.angles: wrong type (number 12.0), allowed: integer");
    EXPECT_EQ(error(minimal + "[output]\nfigures_at_m = 5000\n"),
              "scene.toml:5: output.figures_at_m: wrong type (integer 5000), "
              "allowed: array of numbers");
    EXPECT_EQ(error(minimal + "[output]\nfigures_at_m = [1,\n '2']\n"),
              "scene.toml:6: output.figures_at_m[1]: wrong type (string \"2\"), "
              "allowed: array of numbers");
    EXPECT_EQ(error(minimal + "[bonds]\nstrength_is = 2024-01-01\n"),
              "scene.toml:5: bonds.strength_is: wrong type (date or time), "
              "allowed: one of \"stress\", \"force\"");
    EXPECT_EQ(set_error("seed.x=3"), "--set seed.x=3: seed: wrong type (table), allowed: integer");
    EXPECT_EQ(set_error("output.figures_at_m=[5000"),
              "--set output.figures_at_m=[5000: output.figures_at_m: "
              "wrong type (string \"[5000\"), allowed: array of numbers");
}

TEST_F(SceneTest, ValuesOfAListAreChecked) {
    EXPECT_EQ(error("accuracy = 'finest'\n" + minimal),
              "scene.toml:1: accuracy: unknown value (\"finest\"), did you mean fine?");
    EXPECT_EQ(error_of({.scene = "lis1", .accuracy = "best"}),
              "--accuracy best: accuracy: unknown value (\"best\"), "
              "allowed: draft, standard, fine, sandbox");
    EXPECT_EQ(set_error("bond_healing.measure=opening"),
              "--set bond_healing.measure=opening: bond_healing.measure: "
              "unknown value (\"opening\"), allowed: slip, slip_and_opening");
}

TEST_F(SceneTest, RangesAreChecked) {
    EXPECT_EQ(error("seed = -1\n" + minimal), "scene.toml:1: seed: out of range (-1), "
                                              "allowed: at least 0, at most 9.223372036854776e18");
    EXPECT_EQ(set_error("hanging_wall.porosity=0.9"),
              "--set hanging_wall.porosity=0.9: hanging_wall.porosity: out of range (0.9), "
              "allowed: at least 0.1, at most 0.4");
    EXPECT_EQ(set_error("output.figures_at_m=[1, -2]"),
              "--set output.figures_at_m=[1, -2]: output.figures_at_m[1]: out of range (-2), "
              "allowed: at least 0, at most 1e6");
    EXPECT_THAT(error_of({.scene = "lis1", .seed = -1}),
                StartsWith("--seed -1: seed: out of range (-1), allowed: at least 0"));
}

TEST_F(SceneTest, EveryBoundHolds) {
    // Consistency is checked after the ranges, so that its messages do not matter here.
    const auto accepts = [&](const SceneTable& table, const Parameter& parameter, double x) {
        return set_error(fmt::format("{}{}.{}={}", table.name, table.is_array() ? ".0" : "",
                                     parameter.key, x))
                   .find("out of range") == std::string::npos;
    };
    for (const SceneTable& table : all_tables()) {
        for (const Parameter& parameter : table.parameters) {
            if (!std::holds_alternative<Place<double>>(parameter.value))
                continue;
            SCOPED_TRACE(fmt::format("{}.{}", table.name, parameter.key));
            const Range& range = parameter.range;
            if (std::isfinite(range.from)) {
                EXPECT_TRUE(accepts(table, parameter, range.from));
                EXPECT_FALSE(accepts(table, parameter, std::nextafter(range.from, -1e300)));
            }
            if (std::isfinite(range.above)) {
                EXPECT_TRUE(accepts(table, parameter, std::nextafter(range.above, 1e300)));
                EXPECT_FALSE(accepts(table, parameter, range.above));
            }
            if (std::isfinite(range.to)) {
                EXPECT_TRUE(accepts(table, parameter, range.to));
                EXPECT_FALSE(accepts(table, parameter, std::nextafter(range.to, 1e300)));
            }
            if (std::isfinite(range.below)) {
                EXPECT_TRUE(accepts(table, parameter, std::nextafter(range.below, -1e300)));
                EXPECT_FALSE(accepts(table, parameter, range.below));
            }
            EXPECT_FALSE(accepts(table, parameter, NAN));
            EXPECT_FALSE(accepts(table, parameter, INFINITY));
            EXPECT_FALSE(accepts(table, parameter, -INFINITY));
        }
    }
}

TEST_F(SceneTest, SlipsOfTomlAreToldWithTheirCure) {
    const auto of_line = [&](const std::string& line) {
        return error(minimal + "[extension]\n" + line + "\n[gravity]\n");
    };
    EXPECT_THAT(of_line("rate_m_per_a = 0,01"), EndsWith("this is a decimal comma; write 0.01"));
    EXPECT_THAT(of_line("distance_m = 10 km # all"), EndsWith("; write distance_m = 10000"));
    EXPECT_THAT(of_line("distance_m = 2,5km"), EndsWith("; write distance_m = 2500"));
    EXPECT_THAT(of_line("distance_m = .5"), EndsWith("; write distance_m = 0.5"));
    EXPECT_THAT(of_line("distance_m = \"10 km\""), EndsWith("; write distance_m = 10000"));
    EXPECT_THAT(of_line("rate_m_per_a = \"1 cm\""), HasSubstr("write the number alone"));
    EXPECT_THAT(of_line("distance_m = \u201c10\u201d"), HasSubstr("quotes of typography"));
    EXPECT_THAT(of_line("name = my basin"), EndsWith("; write name = \"my basin\""));
    EXPECT_THAT(of_line("name = True"), EndsWith("; write name = true"));
    EXPECT_THAT(of_line("name = \"C:\\Users\\x.csv\""),
                EndsWith("; write name = 'C:\\Users\\x.csv'"));
    EXPECT_THAT(set_error("extension.distance_m=5km"), EndsWith("; write distance_m = 5000"));
}

TEST_F(SceneTest, SetNeedsItsForm) {
    for (const std::string bad : {"seed", "", "=3", "a b=3", "seed=1\naccuracy='fine'", ".x=1"})
        EXPECT_THAT(set_error(bad), EndsWith("needs the form table.key=value")) << bad;
}

TEST_F(SceneTest, WithoutNeedsAnEffectOfTheScene) {
    const auto without = [&](const std::string& name, const std::string& text) {
        return error(text, {.without = {name}});
    };
    const std::string text = minimal + "[gravity]\n[bonds]\n";
    EXPECT_EQ(without("gravty", text), "--without gravty: unknown table, did you mean gravity? "
                                       "(effects in the scene: gravity, bonds)");
    EXPECT_EQ(without("magnetism", text),
              "--without magnetism: unknown table (effects in the scene: gravity, bonds)");
    EXPECT_EQ(without("sedimentation", text), "--without sedimentation: is not in the scene "
                                              "(effects in the scene: gravity, bonds)");
    EXPECT_EQ(without("hanging_wall", text),
              "--without hanging_wall: is not an effect and cannot be left out "
              "(effects in the scene: gravity, bonds)");
    EXPECT_THAT(
        error(text, {.set = {"bonds.tensile_strength_pa=1e6"}, .without = {"bonds"}}),
        StartsWith("--set bonds.tensile_strength_pa=1e6: changes [bonds], which --without"));
    EXPECT_EQ(without("bonds", minimal),
              "--without bonds: is not in the scene (the scene has no effects)");
}

// ------------------------------------------------------------------------------------ consistency

TEST_F(SceneTest, TheBlockAndItsDetachmentBelongTogether) {
    EXPECT_EQ(error("[gravity]\n"),
              "scene.toml:1: hanging_wall: is missing, every scene needs [hanging_wall]");
    EXPECT_EQ(error("seed = 1\n[hanging_wall]\n"),
              "scene.toml:2: hanging_wall: needs [detachment], the surface on which it slides, "
              "or [stretching]; add one");
    const Scene stretched = load("[hanging_wall]\n[stretching]\nfriction = 0.7\n");
    EXPECT_FALSE(stretched.detachment);
    EXPECT_EQ(bits(load(to_toml(stretched))), bits(stretched));
    EXPECT_DOUBLE_EQ(hanging_wall_area(stretched), 40e3 * 15e3);
    EXPECT_EQ(
        error(minimal + "[stretching]\n"),
        "scene.toml:4: stretching: stands in place of [detachment]; leave out one of the two");
    EXPECT_THAT(error("[hanging_wall]\n[detachment]\n"),
                StartsWith("scene.toml:2: detachment.segments: has no arc and no line"));
    // Found by the fuzzer: check and explain described the fit of a detachment that is not there.
    EXPECT_EQ(error("[hanging_wall]\n[stretching]\n[picked_fault]\n"),
              "scene.toml:3: picked_fault: has the points that a [detachment] was fitted to, which "
              "the scene does not have; leave out [picked_fault]");
}

TEST_F(SceneTest, SegmentsAreArcsOrLines) {
    const auto segments = [&](const std::string& list) {
        return error("[hanging_wall]\n[detachment]\nsegments = [\n" + list + "\n]\n");
    };
    EXPECT_EQ(segments("{arc = {}}"), "scene.toml:4: detachment.segments[0].arc: needs radius_m "
                                      "(radius of the arc; at least 0.001, at most 1e9)");
    EXPECT_EQ(segments("{arc = {radius_m = 1e4}},\n{line = {start_dip_deg = 3}}"),
              "scene.toml:5: detachment.segments[1].line: needs length_m "
              "(length of the line; at least 0.001, at most 1e6)");
    EXPECT_THAT(segments("{arc = {radius_m = 1e4}, line = {length_m = 1e4}}"),
                StartsWith("scene.toml:4: detachment.segments[0]: needs exactly one of arc and "));
    EXPECT_THAT(segments("{}"), HasSubstr("needs exactly one of arc and line"));
    EXPECT_THAT(segments("3"), HasSubstr("needs exactly one of arc and line"));
    EXPECT_EQ(segments("{acr = {radius_m = 1e4}}"),
              "scene.toml:4: detachment.segments[0].acr: unknown segment, did you mean arc?");
    EXPECT_EQ(segments("{arc = 15000}"), "scene.toml:4: detachment.segments[0].arc: "
                                         "wrong type (integer 15000), allowed: table");
    EXPECT_EQ(segments("{arc = {radius = 15000}}"),
              "scene.toml:4: detachment.segments[0].arc.radius: unknown key, "
              "did you mean radius_m?");
    EXPECT_EQ(segments("{line = {length_m = 0}}"),
              "scene.toml:4: detachment.segments[0].line.length_m: out of range (0), "
              "allowed: at least 0.001, at most 1e6");
    EXPECT_EQ(segments("{arc = {radius_m = 1e4, end_dip_deg = 91}}"),
              "scene.toml:4: detachment.segments[0].arc.end_dip_deg: out of range (91), "
              "allowed: at least 0, at most 90; else the detachment rises or folds back");
    EXPECT_EQ(segments("{line = {length_m = 1e4, start_dip_deg = -5}}"),
              "scene.toml:4: detachment.segments[0].line.start_dip_deg: out of range (-5), "
              "allowed: at least 0, at most 90; else the detachment rises or folds back");
    EXPECT_EQ(
        segments("{line = {length_m = 1e4, start_dip_deg = 60}}"),
        "scene.toml:3: detachment.segments: does not join: the first piece has start_dip_deg = "
        "60, but the detachment start_dip_deg = 90; both are the dip at the breakaway, give one");
}

TEST_F(SceneTest, TheDetachmentReachesTheThicknessAndSolesOut) {
    EXPECT_THAT(set_error("hanging_wall.thickness_m=15001.5"),
                AllOf(HasSubstr("lis1.toml:"),
                      HasSubstr(": detachment.segments: reaches a depth "
                                "of 15000.0 m"),
                      HasSubstr("hanging_wall.thickness_m = 15001.5")));
    EXPECT_EQ(set_error("hanging_wall.thickness_m=15000.9"), "no error");
    EXPECT_THAT(set_error("detachment.segments=[{arc={radius_m=15000,end_dip_deg=20}}]"),
                HasSubstr("ends with a dip of 20 degrees, allowed: 0"));
    EXPECT_THAT(set_error("detachment.segments=[{arc={radius_m=15000}},{arc={radius_m=5000}}]"),
                HasSubstr("has an arc that starts and ends with a dip of 0 degrees"));
    // 60 degrees: descends R (1 - cos 60).
    EXPECT_EQ(error("[hanging_wall]\n[detachment]\nstart_dip_deg = 60\n"
                    "segments = [{arc = {radius_m = 30000}}]\n"),
              "no error");
}

TEST_F(SceneTest, RampFlatRamp) {
    // Fillet of the kink at a depth of 7 km: steepens from 0 to 90 degrees and descends its radius.
    const Scene scene = load("[hanging_wall]\n[detachment]\nsegments = [\n"
                             "{arc = {radius_m = 7000}},\n"
                             "{line = {length_m = 5000}},\n"
                             "{arc = {radius_m = 300, end_dip_deg = 90}},\n"
                             "{arc = {radius_m = 7700}},\n"
                             "{line = {length_m = 50000}}]\n");
    const double quarter = 1.0 - pi / 4.0;
    // Below the concave arcs the footwall's corners are missing; the convex one adds a corner.
    const double expected = 7e3 * 7e3 * (1.0 - quarter) + 5e3 * 7e3 +
                            300.0 * (7e3 + 300.0 * quarter) + 7700.0 * 7300.0 +
                            7700.0 * 7700.0 * (1.0 - quarter) + 20e3 * 15e3;
    EXPECT_NEAR(hanging_wall_area(scene) / expected, 1.0, 1e-7);
}

TEST_F(SceneTest, TheExperimentsDifferInTheirDetachmentsAlone) {
    const auto without_detachment = [&](const std::string& name) {
        Scene scene = load_scene({.scene = name});
        scene.name = scene.description = "";
        scene.detachment = load_scene({.scene = "lis1"}).detachment;
        return bits(scene);
    };
    EXPECT_EQ(without_detachment("lis2"), without_detachment("lis1"));
    EXPECT_EQ(without_detachment("rfr"), without_detachment("lis1"));
    Scene control = load_scene({.scene = "lis1", .without = {"fault_weakening", "bond_healing"}});
    control.name = "lis1-0";
    Scene lis1_0 = load_scene({.scene = "lis1-0"});
    lis1_0.description = control.description;
    EXPECT_EQ(bits(lis1_0), bits(control));
}

TEST_F(SceneTest, DetachmentsOfTheExperiments) {
    const auto area = [](const std::string& name) {
        return hanging_wall_area(load_scene({.scene = name}));
    };
    // LIS2: below the flat's depth, a rectangle; over the arc, integral of R (cos a - cos 60).
    const double R = 30e3, a = pi / 3.0, run = R * std::sin(a);
    const double over_arc = R * R * (0.5 * a + 0.25 * std::sin(2.0 * a)) - R * std::cos(a) * run;
    EXPECT_NEAR(area("lis2") / (over_arc + (40e3 - run) * 15e3), 1.0, 1e-7);
    // RFR: the kink is a sharp corner at (12, 7) km but for the sliver that its arc cuts off.
    const double quarter = pi / 4.0;
    const double sharp =
        7e3 * 7e3 * quarter + 5e3 * 7e3 + 8e3 * 7e3 + 8e3 * 8e3 * quarter + 20e3 * 15e3;
    EXPECT_GT(area("rfr"), sharp);
    EXPECT_LT(area("rfr"), sharp + 300.0 * 300.0);
}

TEST_F(SceneTest, AnyChainOfLinesAndArcs) {
    const auto chain = [&](const std::string& list) {
        return error("[hanging_wall]\nthickness_m = 9000\n[detachment]\nstart_dip_deg = 50\n"
                     "segments = [" +
                     list + "]\n");
    };
    // Sharp kinks of both kinds; the flat to beyond the wall is added.
    EXPECT_EQ(
        chain("{line = {length_m = 5221.8291}}, {line = {length_m = 6000, start_dip_deg = 10}}, "
              "{arc = {radius_m = 4788.8, start_dip_deg = 60}}, "
              "{arc = {radius_m = 1563.758, end_dip_deg = 60}}, "
              "{line = {length_m = 781.7, start_dip_deg = 90}}, "
              "{line = {length_m = 100, start_dip_deg = 0}}"),
        "no error");
}

TEST_F(SceneTest, AreaOfTheHangingWall) {
    constexpr double tolerance = 10.0; // m^2; dem adds up small pieces
    const double corner = 15e3 * 15e3 * (1.0 - pi / 4.0);
    Scene scene = load(minimal);
    EXPECT_NEAR(hanging_wall_area(scene), 40e3 * 15e3 - corner, tolerance);
    scene.hanging_wall.length = 7.5e3; // the moving wall stands on the arc
    EXPECT_NEAR(hanging_wall_area(scene), 0.5 * 15e3 * 15e3 * (pi / 3.0 - std::sqrt(3.0) / 4.0),
                tolerance);
    scene.hanging_wall.length = 40e3;
    // Lines only: a triangle and a rectangle.
    const double depth = 10e3 * std::sin(pi / 6.0), run = 10e3 * std::cos(pi / 6.0);
    scene.detachment->segments = {
        {.kind = DetachmentSegment::Kind::line, .length = 10e3, .start_dip = 30.0}};
    EXPECT_NEAR(hanging_wall_area(scene), 0.5 * depth * run + (40e3 - run) * depth, tolerance);
    scene.hanging_wall.length = 0.5 * run;
    EXPECT_NEAR(hanging_wall_area(scene), 0.125 * depth * run, tolerance);
    scene.detachment.reset();
    EXPECT_EQ(hanging_wall_area(scene), 0.0);
    EXPECT_EQ(estimated_discs(Scene{}), 0u);
}

TEST_F(SceneTest, NumberOfDiscs) {
    Scene scene = load(minimal);
    EXPECT_NEAR(estimated_discs(scene), 16380, 10);
    scene.hanging_wall.radius_ratio = 1.0; // all discs alike
    EXPECT_EQ(estimated_discs(scene),
              std::size_t(hanging_wall_area(scene) * 0.825 / (pi * 93.1 * 93.1)));
}

TEST_F(SceneTest, TooFewAndTooManyDiscs) {
    for (const std::string radius : {"9000", "1.5"}) {
        const std::string message = set_error("hanging_wall.mean_radius_m=" + radius);
        EXPECT_THAT(message, StartsWith("--set hanging_wall.mean_radius_m=" + radius +
                                        ": hanging_wall.mean_radius_m: too "));
        // The radius that the message names is indeed accepted, one beyond it is not.
        const bool large = message.find("too large") != message.npos;
        const std::string before = large ? "at most " : "at least ";
        const double bound = std::stod(message.substr(message.find(before) + before.size()));
        const double beyond = large ? 1.01 * bound : 0.99 * bound;
        EXPECT_EQ(set_error(fmt::format("hanging_wall.mean_radius_m={}", bound)), "no error");
        EXPECT_NE(set_error(fmt::format("hanging_wall.mean_radius_m={}", beyond)), "no error");
    }
}

TEST_F(SceneTest, EffectsThatNeedOthers) {
    EXPECT_EQ(error(minimal + "[bond_healing]\n"),
              "scene.toml:4: bond_healing: needs [bonds], which the scene does not have; "
              "add [bonds] or leave out [bond_healing]");
    EXPECT_EQ(error(minimal + "[gravity]\n[compaction]\n"),
              "scene.toml:5: compaction: needs [sedimentation], which the scene does not have; "
              "add [sedimentation] or leave out [compaction]");
    EXPECT_THAT(error(minimal + "[bonds]\n[bond_healing]\n", {.without = {"bonds"}}),
                HasSubstr("bond_healing: needs [bonds]"));
    EXPECT_EQ(error(minimal + "[fault_weakening]\n"), "no error");
}

TEST_F(SceneTest, SedimentAboveTheGroundBehindTheBreakawayIsRefused) {
    const auto of = [](std::vector<std::string> set) {
        set.insert(set.begin(), "detachment.footwall_top_m=30000");
        return error_of({.scene = "lis1", .set = std::move(set)});
    };
    EXPECT_THAT(of({"sedimentation.level_m=400"}),
                AllOf(HasSubstr("--set sedimentation.level_m=400"),
                      HasSubstr("beside detachment.footwall_top_m = 30000"),
                      HasSubstr("such as [[0.0, 0.0], [1000.0, 400]]")));
    EXPECT_THAT(of({"sedimentation.target=[[-9000.0, 50.0], [0.0, 0.0]]"}),
                HasSubstr("sedimentation.target: is 50 at x <= 0"));
    EXPECT_EQ(of({"sedimentation.target=[[0.0, 0.0], [1000.0, 400.0]]"}), "no error");
    EXPECT_EQ(of({"sedimentation.level_m=-400"}), "no error");
    EXPECT_EQ(set_error("sedimentation.level_m=400"), "no error"); // a backstop holds it
    // Erosion down to a line above the ground lays nothing there.
    const std::string rising = "sedimentation.target=[{time_a=0.0, points=[[0.0, 0.0]]}, "
                               "{time_a=500000.0, points=[[0.0, 0.0]]}, "
                               "{time_a=900000.0, points=[[0.0, 300.0]]}]";
    const std::string stages = "stage=[{distance_m=5000.0}, {distance_m=-4000.0, sedimentation=";
    EXPECT_EQ(of({rising, "extension.distance_m=9000.0", stages + "\"erode\"}]"}), "no error");
    EXPECT_THAT(of({rising, "extension.distance_m=9000.0", stages + "\"fill\"}]"}),
                HasSubstr("sedimentation.target: is 300"));
}

// ------------------------------------------------------------------------------------------ files

TEST_F(SceneTest, FilesThatAreNoScenes) {
    const std::string empty = "scene.toml: is empty; a scene has at least [hanging_wall] and "
                              "[detachment] or [stretching]";
    EXPECT_EQ(error(""), empty);
    EXPECT_EQ(error("\n# nothing here\n"), empty);
    EXPECT_EQ(error(std::string("a = 1\n\x7f"
                                "ELF\0\1",
                                12)),
              "scene.toml:2: is not a text file (it has a NUL byte); a scene is TOML in UTF-8");
    EXPECT_EQ(error_of({.scene = folder.string() + "/"}),
              folder.string() + "/: is a directory, needs a scene file");
    EXPECT_THAT(error_of({.scene = "/proc/self/mem"}),
                StartsWith("/proc/self/mem: cannot be read: "));
    EXPECT_EQ(error_of({.scene = "nowhere/scene.toml"}),
              "nowhere/scene.toml: no such file (scenes: " + shipped() + ")");
    EXPECT_THAT(error_of({.scene = std::string(5000, 'a')}), HasSubstr("File name too long"));
}

TEST_F(SceneTest, TomlErrorsHaveLineAndColumn) {
    EXPECT_THAT(error("seed = 1\n[hanging_wall\n"), StartsWith("scene.toml:2:14: "));
    EXPECT_THAT(error("seed = 1\nseed = 2\n"), StartsWith("scene.toml:2:8: "));
    EXPECT_THAT(error("description = \"\xff\"\n"),
                AllOf(StartsWith("scene.toml:1:16: byte 0xff"), HasSubstr("UTF-8")));
}

TEST_F(SceneTest, UnknownScenes) {
    EXPECT_EQ(error_of({.scene = "LIS1"}),
              "LIS1: no such scene, did you mean lis1? (scenes: " + shipped() + ")");
    EXPECT_EQ(error_of({.scene = "magnetism"}),
              "magnetism: no such scene (scenes: " + shipped() + ")");
    EXPECT_EQ(error_of({.scene = "lis1.toml"}),
              "lis1.toml: no such file, did you mean lis1? (scenes: " + shipped() + ")");
    EXPECT_EQ(error_of({.scene = ""}), "\"\": no such scene (scenes: " + shipped() + ")");
}

TEST_F(SceneTest, AnotherScenesFolder) {
    write(minimal, "mine.toml");
    write("description = 'broken", "broken.toml");
    write("description = 'first'\n" + minimal, "a.toml");
    write("no scene", "notes.txt");
    setenv("LISTRIC_SCENES", folder.c_str(), 1);
    EXPECT_EQ(load_scene({.scene = "mine"}).name, "mine");
    const auto scenes = list_scenes();
    ASSERT_EQ(scenes.size(), 3u);
    EXPECT_EQ(scenes[0], std::pair(std::string("a"), std::string("first")));
    EXPECT_THAT(scenes[1].second, HasSubstr("broken.toml:1:"));
    EXPECT_EQ(scenes[2], std::pair(std::string("mine"), std::string()));
    EXPECT_EQ(error_of({.scene = "mime"}),
              "mime: no such scene, did you mean mine? (scenes: a, broken, mine)");
    setenv("LISTRIC_SCENES", "/nowhere", 1);
    EXPECT_THROW(list_scenes(), SceneError);
    EXPECT_THAT(error_of({.scene = "mine"}), StartsWith("/nowhere: scenes folder cannot be read"));
}

TEST_F(SceneTest, ShippedScenesLoad) {
    const auto scenes = list_scenes();
    EXPECT_TRUE(std::ranges::is_sorted(scenes));
    for (const auto& [name, description] : scenes) {
        EXPECT_EQ(error_of({.scene = name}), "no error");
        EXPECT_FALSE(description.empty()) << name;
    }
}

// ---------------------------------------------------------------------------------------- writing

TEST_F(SceneTest, WhatIsWrittenReadsBackTheSame) {
    for (const auto& [name, description] : list_scenes())
        for (const std::string accuracy : {"draft", "standard", "fine", "sandbox"}) {
            const Scene scene = load_scene({.scene = name, .accuracy = accuracy});
            EXPECT_EQ(bits(load(to_toml(scene))), bits(scene));
        }
    const Scene plain = load(minimal);
    EXPECT_EQ(bits(load(to_toml(plain))), bits(plain));
    EXPECT_EQ(to_toml(load(to_toml(plain))), to_toml(plain));
}

TEST_F(SceneTest, TextsAndSeedsReadBackTheSame) {
    Scene scene = load(minimal);
    scene.seed = 9223372036854775807u;
    for (const std::string text : {"", "a \"b\" \\ 'c'", "two\nlines\r\n", "tab\t\x01\x7f",
                                   "Störung", "# no comment", "'''", "\"\"\""}) {
        scene.description = text;
        EXPECT_EQ(bits(load(to_toml(scene))), bits(scene)) << text;
    }
}

TEST_F(SceneTest, AwkwardNumbersReadBackTheSame) {
    using Kind = DetachmentSegment::Kind;
    std::mt19937_64 random(1);
    for (int trial = 0; trial < 50; ++trial) {
        Scene scene = load_scene({.scene = "lis1"});
        for (const SceneTable& table : all_tables()) {
            if (table.name == "hanging_wall" || table.name == "detachment")
                continue; // checked against each other
            if (table.name == "elastic_base" || table.name == "lower_crust_thinning" ||
                table.name == "basin_water" || table.name == "footwall_erosion" ||
                table.name == "base_motion" || table.name == "stretching" ||
                table.name == "energy" || table.name == "pore_fluid" || table.name == "stage" ||
                table.name == "layer" || table.name == "old_fault" || table.name == "bed" ||
                table.name == "heat") {
                table.drop(table, scene); // checked against each other
                continue;
            }
            void* const part = table.add(table, scene);
            for (const Parameter& parameter : table.parameters) {
                const double from = std::max(parameter.range.from, parameter.range.above);
                const double to = std::min(parameter.range.to, parameter.range.below);
                if (const auto* choice = std::get_if<Choice>(&parameter.value)) {
                    choice->set(part, choice->names,
                                choice->names[random() % choice->names.size()]);
                    continue;
                }
                double x = std::uniform_real_distribution(from, to)(random);
                if (parameter.key == "level_m")
                    x = std::abs(x); // a level below the hanging wall is refused
                if (const auto* choice = std::get_if<Place<bool>>(&parameter.value)) {
                    choice->reach(part) = random() % 2 == 0;
                    continue;
                }
                if (const auto* number = std::get_if<Place<double>>(&parameter.value))
                    number->reach(part) = x / parameter.per_si;
                else if (const auto* integer = std::get_if<Place<int>>(&parameter.value))
                    integer->reach(part) = static_cast<int>(x);
                else if (const auto* list =
                             std::get_if<Place<std::vector<double>>>(&parameter.value))
                    list->reach(part) = {x, 0.1, 1.0 / 3.0, 1e6};
            }
        }
        const double thickness = std::uniform_real_distribution(12e3, 18e3)(random);
        scene.hanging_wall.thickness = thickness;
        scene.hanging_wall.length = 2.7 * thickness;
        scene.hanging_wall.mean_radius = thickness / 151.3;
        scene.hanging_wall.porosity = 0.1 + thickness * 1e-5;
        scene.detachment->friction = thickness / 20e3;
        scene.detachment->segments = {
            {.kind = Kind::arc, .radius = thickness / 3.0},
            {.kind = Kind::line, .length = 2.0 / 3.0 * thickness, .start_dip = 90.0},
            {.kind = Kind::line, .length = 4.0 * thickness, .start_dip = 0.0}};
        ASSERT_EQ(bits(load(to_toml(scene))), bits(scene));
    }
}

TEST_F(SceneTest, BasinsOnABaseThatBendsAreSaturated) {
    int filled = 0;
    for (const auto& [name, description] : list_scenes()) {
        const Scene scene = load_scene({.scene = name});
        if (bending_base(scene) && has_effect(scene, "sedimentation")) {
            ++filled;
            EXPECT_TRUE(has_effect(scene, "basin_water")) << name;
        }
    }
    EXPECT_GE(filled, 3);
}

TEST_F(SceneTest, WhatAnElasticBaseLacksHasASize) {
    int lacks = 0;
    for (const Effect* effect : program_effects()) {
        // A load on the base is missed where it is off.
        EXPECT_TRUE(!effect->load_footwall || !effect->absence.what.empty()) << effect->name;
        std::vector<Lack> all = effect->lacks;
        all.push_back(effect->absence);
        for (const Lack& lack : all) {
            lacks += !lack.what.empty();
            EXPECT_EQ(lack.what.empty(), lack.size.empty()) << effect->name << ": " << lack.what;
        }
    }
    EXPECT_GE(lacks, 8);
}

TEST_F(SceneTest, ElasticBasesReadBackTheSame) {
    std::mt19937_64 random(3);
    for (int trial = 0; trial < 50; ++trial) {
        Scene scene = load_scene({.scene = "lis1-elastic"});
        const double x = std::uniform_real_distribution(0.0, 0.5)(random);
        scene.find<ElasticBaseParameters>()->bending = {.elastic_thickness = 1e4 * (1 + x),
                                                        .young_modulus = 1e11 * x + 1e6,
                                                        .poisson_ratio = x,
                                                        .crust_density = 2700 + x,
                                                        .mantle_density = 3300 + x,
                                                        .infill_density = x,
                                                        .left = -3e5 - x,
                                                        .cells = 7,
                                                        .degree = 1};
        ASSERT_EQ(bits(load(to_toml(scene))), bits(scene));
    }
}

TEST_F(SceneTest, LoadsOnTheBaseNeedOneThatBends) {
    EXPECT_THAT(error(minimal + "[elastic_base]\n"), HasSubstr("elastic_base: needs [gravity]"));
    for (const std::string load : {"lower_crust_thinning", "basin_water", "footwall_erosion"})
        EXPECT_THAT(error(minimal + "[" + load + "]\n"),
                    HasSubstr(load + ": needs [elastic_base]"));
}

TEST_F(SceneTest, UnitsThatAreNotSiReadBackTheSame) {
    const auto with_coefficient = [&](const std::string& value) {
        return load_with({"sedimentation={}", "compaction.coefficient_per_km=" + value});
    };
    std::mt19937_64 random(2);
    std::uniform_real_distribution exponent(-6.0, 1.0);
    for (int trial = 0; trial < 100; ++trial) {
        const std::string value = fmt::format("{}", std::pow(10.0, exponent(random)));
        const Scene scene = with_coefficient(value);
        ASSERT_EQ(load(to_toml(scene)).find<CompactionParameters>()->coefficient,
                  scene.find<CompactionParameters>()->coefficient)
            << value;
    }
    for (const std::string value : {"0.0", "0.4", "0.27", "0.3", "0.51", "0.7", "10.0", "1e-310"})
        EXPECT_THAT(to_toml(with_coefficient(value)),
                    HasSubstr("\ncoefficient_per_km = " + value + " "));
}

TEST_F(SceneTest, WhatIsWrittenReadsWell) {
    const std::string text = to_toml(load_scene({.scene = "lis1"}));
    EXPECT_THAT(text, StartsWith("# All parameters in force.\n\nname = \"lis1\""));
    EXPECT_THAT(text, HasSubstr("\nmean_radius_m = 93.1                      # mean disc radius"));
    EXPECT_THAT(text, HasSubstr("\nnormal_stiffness_pa = 1.7e11 "));
    EXPECT_THAT(text, HasSubstr("\nsegments = [\n"
                                "    {arc = {radius_m = 15000.0, end_dip_deg = 0.0}},\n"
                                "    {line = {length_m = 60000.0}},\n"
                                "]"));
    EXPECT_THAT(to_toml(load(minimal)), Not(HasSubstr("[gravity]")));
}

// ----------------------------------------------------------------------------------- declarations

TEST_F(SceneTest, TheReferenceHasEveryParameter) {
    const std::string reference = parameter_reference(program_effects());
    for (const SceneTable& table : all_tables()) {
        EXPECT_THAT(reference, HasSubstr("\n" + table.heading()));
        for (const Parameter& parameter : table.parameters) {
            EXPECT_THAT(reference, HasSubstr(fmt::format("    {} = ", parameter.key)));
            EXPECT_THAT(reference, HasSubstr(std::string(parameter.doc)));
        }
    }
    EXPECT_THAT(reference, HasSubstr("    porosity = 0.175\n"
                                     "        porosity of the closed packing, before gravity is "
                                     "applied\n"
                                     "        Raising it makes the packing looser, with fewer "
                                     "contacts and bonds per disc.\n"
                                     "        number; at least 0.1, at most 0.4; symbol Phi_d; "
                                     "usual 0.17 to 0.175\n"));
    EXPECT_THAT(reference, HasSubstr("    radius_m = (required)\n"));
}

TEST_F(SceneTest, KeysEndWithTheirUnits) {
    for (const SceneTable& table : all_tables())
        for (const Parameter& parameter : table.parameters) {
            std::string unit(parameter.unit); // kg/m3: _kg_per_m3, 1/s: _per_s, Pa s: _pa_s,
                                              // W/m/K: _w_per_m_k, degC: _c
            std::ranges::replace(unit, ' ', '_');
            std::ranges::transform(unit, unit.begin(), [](char c) { return std::tolower(c); });
            if (const auto slash = unit.find('/'); slash != unit.npos)
                unit.replace(slash, 1, "_per_");
            std::ranges::replace(unit, '/', '_');
            if (unit == "degc")
                unit = "c";
            if (unit.starts_with("1_"))
                unit.erase(0, 2);
            if (!unit.empty()) {
                EXPECT_THAT(std::string(parameter.key), EndsWith("_" + unit)) << table.name;
            }
        }
}

TEST_F(SceneTest, DefaultsAreInTheirRanges) {
    Scene scene;
    for (const SceneTable& table : all_tables()) {
        const void* const part = table.add(table, scene);
        for (const Parameter& parameter : table.parameters) {
            EXPECT_FALSE(parameter.doc.empty()) << parameter.key;
            if (const auto* number = std::get_if<Place<double>>(&parameter.value)) {
                EXPECT_TRUE(parameter.range.contains(number->get(part) * parameter.per_si))
                    << table.name << "." << parameter.key;
            }
        }
    }
}

TEST_F(SceneTest, TablesComeAndGo) {
    Scene scene;
    for (const SceneTable& table : all_tables()) {
        EXPECT_EQ(table.in(scene), !table.drop) << table.name;
        void* const part = table.add(table, scene);
        EXPECT_EQ(part, table.find(table, scene)) << table.name;
        EXPECT_EQ(part, table.add(table, scene)) << table.name; // what is there stays
    }
    for (const SceneTable& table : all_tables())
        if (table.drop)
            table.drop(table, scene);
    EXPECT_EQ(bits(scene), bits(Scene{}));
}

TEST(Nearest, FindsMisspeltNames) {
    const std::vector<std::string_view> names{"damping", "time_step_safety", "skin", "length_m"};
    EXPECT_EQ(nearest("dampign", names), "damping"); // swapped
    EXPECT_EQ(nearest("dampin", names), "damping");  // missing
    EXPECT_EQ(nearest("skins", names), "skin");      // too many
    EXPECT_EQ(nearest("timestep_safety", names), "time_step_safety");
    EXPECT_EQ(nearest("length_km", names), "length_m");
    EXPECT_EQ(nearest("LENGTH", names), "length_m"); // no unit
    const std::vector<std::string_view> panels{"layer-strain", "strain", "layer-overpressure"};
    EXPECT_EQ(nearest("overpressure", panels), "layer-overpressure"); // no family
    EXPECT_EQ(nearest("STRAIN", panels), "strain");
    EXPECT_EQ(nearest("colour", names), std::nullopt);
    EXPECT_EQ(nearest("", names), std::nullopt);
    EXPECT_EQ(nearest(std::string(1'000'000, 'x'), names), std::nullopt);
}

TEST(Text, NumbersAreShortAndExact) {
    EXPECT_EQ(text(0.175), "0.175");
    EXPECT_EQ(text(15000.0), "15000");
    EXPECT_EQ(text(1e6), "1e6");
    EXPECT_EQ(text(-1.7e11), "-1.7e11");
    EXPECT_EQ(text(1.7e300), "1.7e300");
    EXPECT_EQ(text(1e-15), "1e-15");
    EXPECT_EQ(text(0.1 + 0.2), "0.30000000000000004");
    EXPECT_EQ(text(Range{.above = 0, .to = 10}), "above 0, at most 10");
    EXPECT_EQ(text(Range{.from = 0, .below = 1}), "at least 0, below 1");
    EXPECT_EQ(text(Range{}), "");
}

} // namespace
} // namespace listric::scene_test
