// Defaults that stand for metres of travel follow the geological rate; what is stated stays; a rate
// at which faults cannot be found is told.

#include "apps/commands/explain.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/toml/schema.hpp"
#include "apps/scene/toml/template.hpp"
#include "apps/studies/sweep/sweep_plan.hpp"
#include "dem/event.hpp"
#include "dem/events/bond_healing.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/sedimentation.hpp"
#include "dem/numbers/round_off.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <cstdint>
#include <map>
#include <set>

namespace listric::rate_test {

using namespace dem;
namespace {

using namespace support;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// From the least to the greatest that a scene may have; thirds, whose years have no end.
constexpr double rates[] = {1e-9,  1.7e-5, 0.0001, 0.0002, 0.00035, 0.0007, 0.001,
                            0.003, 0.006,  0.01,   0.012,  0.07,    1.0};

std::string rate_is(double rate) { return fmt::format("extension.rate_m_per_a={}", rate); }

Scene scene_of(const std::string& name, const std::vector<std::string>& set) {
    return load_scene({.scene = name, .set = set});
}

/// Meaning of a scene's parameters that follow the rate: metres of travel, or strain in 25 m.
std::map<std::string, std::uint64_t> ways(const Scene& scene) {
    std::map<std::string, std::uint64_t> all;
    for (const EffectPart& part : scene.effects)
        for (const Parameter& parameter : part.effect->parameters) {
            if (!parameter.follows_rate)
                continue;
            const double value = std::get<Place<double>>(parameter.value)
                                     .get(part.effect->address.get(part.parameters));
            const double rate = scene.extension.rate;
            const double way = parameter.unit == "a" ? Schedule(value, rate).spacing()
                                                     : Schedule::every(25.0, rate).strain(value);
            all[fmt::format("{}.{}", part.effect->name, parameter.key)] =
                std::bit_cast<std::uint64_t>(way);
        }
    return all;
}

/// Loads on an elastic base that have intervals.
const std::vector<std::string> elastic{"basin_water={}", "footwall_erosion={}"};

TEST(Rate, DefaultsStandForTheSameMetresToTheLastBit) {
    for (const char* name : {"lis1", "lis1-elastic", "rfr"})
        for (const double rate : rates) {
            auto set = std::string(name) == "lis1-elastic" ? elastic : std::vector<std::string>{};
            const auto usual = ways(scene_of(name, set));
            set.push_back(rate_is(rate));
            const Scene scene = scene_of(name, set);
            EXPECT_EQ(ways(scene), usual) << name << ", " << rate;
            EXPECT_GE(usual.size(), 7u);
        }
    const auto wet = ways(scene_of("lis1", {"pore_fluid={}"}));
    for (const double rate : rates)
        EXPECT_EQ(ways(scene_of("lis1", {"pore_fluid={}", rate_is(rate)})), wet) << rate;
}

TEST(Rate, DefaultsAreRoundNumbersOfYears) {
    const Scene slow = scene_of("lis1", {rate_is(0.0002)});
    const auto& faults = *slow.find<FaultWeakeningParameters>();
    EXPECT_EQ(faults.interval, 2.5e6);
    EXPECT_EQ(faults.update_interval, 125e3);
    EXPECT_EQ(faults.youngest_sediment, 1e7);
    EXPECT_EQ(slow.find<BondHealingParameters>()->strain_rate, 2e-17);
}

TEST(Rate, TheUsualRateKeepsTheDefaultsThatAreDeclared) {
    const Scene scene = scene_of("lis1", {});
    const auto& faults = *scene.find<FaultWeakeningParameters>();
    EXPECT_EQ(faults.interval, FaultWeakeningParameters{}.interval);
    EXPECT_EQ(faults.resting_rate, FaultWeakeningParameters{}.resting_rate);
    EXPECT_EQ(scene.find<SedimentationParameters>()->interval, SedimentationParameters{}.interval);
    EXPECT_EQ(scene.find<BondHealingParameters>()->strain_rate,
              BondHealingParameters{}.strain_rate);
}

TEST(Rate, WhatIsStatedStays) {
    const Scene scene = scene_of("lis1-mud", {rate_is(0.001), "fault_weakening.interval_a=50000",
                                              "bond_healing.strain_rate_per_s=1e-15"});
    EXPECT_EQ(scene.find<FaultWeakeningParameters>()->interval, 5e4);
    EXPECT_EQ(scene.find<FaultWeakeningParameters>()->update_interval, 25e3);
    EXPECT_EQ(scene.find<BondHealingParameters>()->strain_rate, 1e-15);
    EXPECT_EQ(scene.find<BondHealingParameters>()->interval, 25e3);
    EXPECT_EQ(scene.find<SedimentationParameters>()->interval, 1e4); // by the file
}

class RateFiles : public SceneRuns {};

TEST_F(RateFiles, ARecordStatesTheValuesAndReadsBackTheSame) {
    for (const double rate : rates) {
        const Scene scene = scene_of("lis1", {rate_is(rate)});
        const auto file = folder / "record.toml";
        std::ofstream(file) << to_toml(scene);
        const Scene again = load_scene({.scene = file.string(), .is_record = true});
        EXPECT_EQ(to_toml(again), to_toml(scene)) << rate;
        EXPECT_EQ(ways(again), ways(scene)) << rate;
    }
}

TEST_F(RateFiles, ATemplateShowsTheValuesOfTheScenesRate) {
    const std::string text = small_halfgraben() + "[extension]\nrate_m_per_a = 0.001\n"
                                                  "[gravity]\n[bonds]\n[fault_weakening]\n";
    load(text);
    EXPECT_THAT(scene_template((folder / "small.toml").string(), program_effects()),
                HasSubstr("# interval_a = 500000.0"));
}

/// Parameters in years or per second that mean time or a rate at any speed of the wall.
const std::set<std::string> means_time{
    "stage.pause_a",                     // a span that the scene is about
    "stage.step_a",                      // and a part of it
    "bed.until_a",                       // an age that the scene is about
    "fault_weakening.heal_after_a",      // off; one who states it means years
    "fault_weakening.strain_rate_per_s", // off; the paper's other definition of a fault
    "heat.interval_a", // heat diffuses in years; a length of travel bounds it, too
};

TEST(Rate, EveryTimeAndStrainRateOfAnEffectFollowsOrMeansTime) {
    for (const Effect* effect : program_effects())
        for (const Parameter& parameter : effect->parameters)
            if (parameter.unit == "a" || parameter.unit == "1/s") {
                const std::string path = fmt::format("{}.{}", effect->name, parameter.key);
                EXPECT_NE(parameter.follows_rate, means_time.contains(path)) << path;
                EXPECT_FALSE(parameter.follows_rate && effect->items) << path;
            }
}

TEST(Rate, TheReferenceSaysWhatFollows) {
    const std::string reference = parameter_reference(program_effects());
    const std::string words = "the default is for 0.01 m/a and follows extension.rate_m_per_a";
    EXPECT_THAT(reference, HasSubstr(words));
    const auto schema = nlohmann::json::parse(scene_schema(program_effects()));
    const auto& interval = schema["properties"]["fault_weakening"]["properties"]["interval_a"];
    EXPECT_EQ(interval["default"], 50000.0);
    EXPECT_EQ(interval["x-listric"]["usual_rate_m_per_a"], 0.01);
    EXPECT_THAT(interval["description"].get<std::string>(), HasSubstr(words));
}

std::vector<std::string> warnings(const std::vector<std::string>& set,
                                  const std::string& scene = "lis1") {
    return scene_of(scene, set).warnings;
}

const auto few_faults =
    AllOf(HasSubstr("fault_weakening.interval_a"), HasSubstr("few faults are found"));

TEST(Rate, AStatedIntervalThatIsTooShortIsTold) {
    for (const double rate : rates)
        EXPECT_THAT(warnings({rate_is(rate)}), IsEmpty()) << rate;
    const std::string stated = "fault_weakening.interval_a=50000";
    EXPECT_THAT(warnings({stated}), IsEmpty());
    EXPECT_THAT(warnings({stated, rate_is(0.005)}), IsEmpty()); // 250 m: four times 62
    EXPECT_THAT(
        warnings({stated, rate_is(0.001)}),
        ElementsAre(AllOf(few_faults, HasSubstr("0.001 m/a"), HasSubstr("50 m"), HasSubstr("62 m"),
                          HasSubstr("248000 a"), HasSubstr("left out, it is 500000"))));
    // Another definition of a fault: slip in proportion to the time.
    EXPECT_THAT(warnings({"fault_weakening.strain_rate_per_s=1e-13", rate_is(0.001)}),
                ElementsAre(few_faults));
    EXPECT_THAT(warnings({"fault_weakening.least_slip_m=200"}), ElementsAre(few_faults));
}

TEST(Rate, TheSlowestStageIsToldOf) {
    const std::string stages = "stage=[{distance_m=2000.0}, {pause_a=1e5}, "
                               "{distance_m=2000.0, rate_m_per_a=0.001}]";
    const std::string distance = "extension.distance_m=23000"; // the stages' ways
    EXPECT_THAT(warnings({stages, distance}),
                ElementsAre(AllOf(few_faults, HasSubstr("0.001 m/a of stage[2]"),
                                  HasSubstr("248000 a"), Not(HasSubstr("left out")))));
    EXPECT_THAT(warnings({stages, distance, "fault_weakening.interval_a=250000"}), IsEmpty());
    EXPECT_THAT(
        warnings({"stage=[{distance_m=2000.0}, {pause_a=1e5}]", "extension.distance_m=3000"}),
        IsEmpty());
}

TEST_F(RateFiles, APlanOfASweepTellsOfItsPoints) {
    const auto file = folder / "rates.toml";
    std::ofstream(file) << "scene = \"lis1\"\nmeasures = [\"weak_fraction\"]\n"
                           "set = \"fault_weakening.interval_a=50000\"\n"
                           "[[vary]]\nparameter = \"extension.rate_m_per_a\"\n"
                           "values = [0.01, 0.001]\n";
    const SweepPlan plan = load_sweep_plan(file);
    EXPECT_THAT(check_points(plan, sweep_points(plan), file),
                ElementsAre(AllOf(HasSubstr("run 2, extension.rate_m_per_a=0.001"), few_faults)));
}

TEST(Rate, ExplainShowsStatedIntervalsAsTravel) {
    const CycleSpeed speed{.team = 1e7, .one_thread = 1e7};
    const auto text = [&](const std::vector<std::string>& set) {
        return explain(scene_of("lis1-mud", set), speed, 1, program_effects());
    };
    EXPECT_THAT(text({rate_is(0.001)}),
                AllOf(HasSubstr("sedimentation.interval_a: 10000 a are 10 m of travel, by default "
                                "500 m"),
                      Not(HasSubstr("fault_weakening.interval_a")),
                      HasSubstr("62 m in 500000 a, 500 m of travel")));
}

TEST(RoundOff, LeavesTwelveDigits) {
    EXPECT_EQ(without_round_off(0.1 + 0.2), 0.3);
    EXPECT_EQ(without_round_off(-1e-15 * (2500.0 * 31557600.0)), -7.8894e-5);
    EXPECT_EQ(without_round_off(1.0 / 3.0), 0.333333333333);
    EXPECT_EQ(without_round_off(0.0), 0.0);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(without_round_off(infinity), infinity);
}

} // namespace
} // namespace listric::rate_test
