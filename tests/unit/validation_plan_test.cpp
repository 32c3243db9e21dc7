// Contents of a validation plan, and verdicts of seeds on an expectation.

#include "apps/model/effects.hpp"
#include "apps/scene/scene.hpp"
#include "apps/studies/validation_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace listric {

using namespace dem;
namespace {

using testing::HasSubstr;

const std::string plan_text = R"([[run]]
name = "a"
scene = "lis1"
set = "extension.distance_m=10 material.friction=0.5"
at_m = [5, 10]
[[run]]
name = "b"
scene = "lis1"
without = "bond_healing"
seeds = 2
at_m = [10]
[[experiment]]
name = "one"
runs = "a b"
expect = [
    {measure = "area_balance", what = "first", expected = 2, tolerance = 0.5, at_m = 5},
    {measure = "weak_fraction", what = "second", run = "b", least = 1, needed = "most"},
    {measure = "antithetic_turn_deg", what = "third", minus = "b", most = 3},
]
[[experiment]]
name = "two"
runs = "b"
like = "one"
compare = "a"
)";

class Plan : public testing::Test {
protected:
    std::filesystem::path file =
        std::filesystem::temp_directory_path() /
        ("plan-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
         ".toml");
    ~Plan() override { std::filesystem::remove(file); }
    ValidationPlan load(const std::string& text) {
        std::ofstream(file) << text;
        return load_validation_plan(file);
    }
    std::string complaint(const std::string& from, const std::string& to) {
        std::string text = plan_text;
        text.replace(text.find(from), from.size(), to);
        try {
            load(text);
        } catch (const SceneError& error) {
            return error.what();
        }
        return "none";
    }
};

TEST_F(Plan, SaysWhatIsRunAndExpected) {
    const ValidationPlan plan = load(plan_text);
    EXPECT_THAT(plan.run("a").set,
                testing::ElementsAre("extension.distance_m=10", "material.friction=0.5"));
    EXPECT_THAT(plan.run("b").without, testing::ElementsAre("bond_healing"));
    EXPECT_EQ(plan.run("b").seeds, 2);
    const ValidationExperiment& one = plan.experiments[0];
    ASSERT_EQ(one.expectations.size(), 3u);
    EXPECT_EQ(one.expectations[0].run, "a");
    EXPECT_EQ(one.expectations[0].at, 5.0);
    EXPECT_EQ(one.expectations[0].target(), "2.00 ± 0.50");
    EXPECT_EQ(one.expectations[1].run, "b");
    EXPECT_EQ(one.expectations[2].minus, "b");
    // The other's expectations of its first run alone, now of this one's.
    const ValidationExperiment& two = plan.experiments[1];
    ASSERT_EQ(two.expectations.size(), 1u);
    EXPECT_EQ(two.expectations[0].measure, "area_balance");
    EXPECT_EQ(two.expectations[0].run, "b");
}

TEST_F(Plan, AMeasureThatNoRunCanHaveIsRefused) {
    EXPECT_THAT(complaint("area_balance", "area_balence"),
                HasSubstr("measure: area_balence is no measure, did you mean area_balance?"));
    EXPECT_THAT(complaint("area_balance", "energy_residual"),
                HasSubstr("is a measure of [energy], which no run of the plan has"));
    EXPECT_EQ(complaint("area_balance", "deposited_fraction"), "none");
}

TEST_F(Plan, MayExtendAnother) {
    const std::string own = R"(extends = "validation"
[[run]]
name = "mine"
scene = "lis2"
at_m = [5000, 10000, 12000]
[[run]]
name = "mine-0"
scene = "lis2"
without = "fault_weakening bond_healing"
at_m = [5000, 10000, 12000]
[[experiment]]
name = "mine"
runs = "mine mine-0"
like = "lis2"
)";
    const auto shipped =
        load_validation_plan(LISTRIC_SOURCE_DIR "/apps/studies/validation.toml").experiments;
    const auto lis2 = std::ranges::find(shipped, "lis2", &ValidationExperiment::name);
    const ValidationPlan plan = load(own);
    ASSERT_EQ(plan.experiments.size(), 1u);
    // All of them, the control's by the second run; without one only those of the first.
    const std::vector<Expectation>& all = plan.experiments[0].expectations;
    ASSERT_EQ(all.size(), lis2->expectations.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Expectation& theirs = lis2->expectations[k];
        EXPECT_EQ(all[k].target(), theirs.target());
        EXPECT_EQ(all[k].run, theirs.run == "lis2" ? "mine" : "mine-0");
        EXPECT_EQ(all[k].minus, theirs.minus.empty() ? "" : "mine-0");
    }
    std::string alone = own;
    alone.replace(alone.find("mine mine-0"), 11, "mine");
    const auto fewer = load(alone).experiments[0].expectations;
    EXPECT_LT(fewer.size(), all.size());
    EXPECT_THAT(fewer, testing::Each(testing::Field(&Expectation::minus, "")));
    EXPECT_THAT(complaint("[[run]]", "extends = \"validatoin\"\n[[run]]"),
                HasSubstr("did you mean validation?"));
    EXPECT_THAT(complaint("[[run]]", "extends = \"" + file.filename().string() + "\"\n[[run]]"),
                AllOf(HasSubstr(":1:"), HasSubstr("extended itself")));
}

TEST_F(Plan, TheOneThatIsShippedCanBeRead) {
    const ValidationPlan plan =
        load_validation_plan(LISTRIC_SOURCE_DIR "/apps/studies/validation.toml");
    std::vector<std::string> scenes;
    for (const auto& [name, description] : list_scenes())
        scenes.push_back(name);
    for (const ValidationRun& run : plan.runs)
        EXPECT_THAT(scenes, testing::Contains(run.scene)) << run.name;
    for (const ValidationExperiment& x : plan.experiments)
        for (const Expectation& e : x.expectations)
            if (e.at) {
                EXPECT_THAT(plan.run(e.run).at, testing::Contains(*e.at)) << e.what;
            }
}

TEST_F(Plan, ErrorsNameLineKeyAndCure) {
    EXPECT_THAT(complaint("tolerance", "tolerence"),
                AllOf(HasSubstr(":16:"), HasSubstr("did you mean tolerance?")));
    EXPECT_THAT(complaint("run = \"b\"", "run = \"c\""), HasSubstr("no run c"));
    EXPECT_THAT(complaint("\"most\"", "\"few\""), HasSubstr("allowed: each, most, mean"));
    EXPECT_THAT(complaint("expected = 2, ", "expected = 2, least = 1, "), HasSubstr("one or the"));
    EXPECT_THAT(complaint("like = \"one\"", "like = \"three\""), HasSubstr("no experiment three"));
    EXPECT_THAT(complaint("at_m = [10]", ""), HasSubstr("needs at_m"));
}

using Values = std::vector<std::optional<double>>;

TEST(Judge, EachSeedMostOfThemOrTheirMean) {
    Expectation e;
    e.least = 1.0;
    const Values values{0.0, 1.0, 5.0};
    EXPECT_FALSE(judge(e, values).fulfilled);
    EXPECT_EQ(judge(e, values).text, "missed: met in 2 of 3 seeds");
    e.needed = Expectation::Needed::most;
    EXPECT_TRUE(judge(e, values).fulfilled);
    EXPECT_EQ(judge(e, values).text, "met in 2 of 3 seeds");
    e.least = 2.0;
    EXPECT_FALSE(judge(e, values).fulfilled); // 1 of 3
    e.needed = Expectation::Needed::mean;
    EXPECT_TRUE(judge(e, values).fulfilled); // 2
    e.least = 2.1;
    EXPECT_FALSE(judge(e, values).fulfilled);
    // Half is not most.
    e.needed = Expectation::Needed::most;
    EXPECT_FALSE(judge(e, Values{0.0, 5.0}).fulfilled);
}

TEST(Judge, WhatHasNoValueIsMissedUnlessItMayBeAbsent) {
    Expectation e;
    e.least = 10.0;
    EXPECT_FALSE(judge(e, Values{std::nullopt, 12.0}).fulfilled);
    e.absent = Expectation::Absent::met;
    EXPECT_TRUE(judge(e, Values{std::nullopt, 12.0}).fulfilled);
    EXPECT_FALSE(judge(e, Values{std::nullopt, 9.0}).fulfilled);
}

TEST(Judge, NothingIsClaimedWithoutRunsOrExpectation) {
    Expectation e;
    EXPECT_EQ(judge(e, Values{1.0}).text, "reported");
    e.expected = 1.0;
    EXPECT_EQ(judge(e, Values{}).text, "no run yet");
    EXPECT_FALSE(judge(e, Values{}).fulfilled);
    EXPECT_TRUE(judge(e, Values{1.0}).fulfilled);
    EXPECT_FALSE(judge(e, Values{1.1}).fulfilled);
}

} // namespace
} // namespace listric
