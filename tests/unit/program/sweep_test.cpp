// Plans of many runs, their table, and the effects of their parameters.

#include "apps/studies/sweep/sweep_effects.hpp"
#include "apps/studies/sweep/sweep_plan.hpp"
#include "apps/studies/sweep/sweep_table.hpp"
#include "apps/support/error.hpp"
#include "tests/message_of.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

namespace listric::sweep_test {

namespace {

using testing::HasSubstr;

const std::string plan_text = R"(scene = "lis1"
accuracy = "draft"
seeds = 2
first_seed = 6
design = "grid"
set = "extension.distance_m=100"
measures = ["strain_top10", "strain_top10@50"]
[[vary]]
parameter = "fault_weakening.friction"
values = [0, 0.2]
[[vary]]
parameter = "materials.basement"
values = ["mat18-b", "mat18-b-calibrated"]
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

class SweepPlanFile : public testing::Test {
protected:
    std::filesystem::path file =
        std::filesystem::temp_directory_path() /
        ("sweep-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
         ".toml");
    ~SweepPlanFile() override { std::filesystem::remove(file); }

    SweepPlan load(const std::string& text) {
        std::ofstream(file) << text;
        return load_sweep_plan(file);
    }
    std::string complaint(const std::string& from, const std::string& to) {
        return support::message_of<SceneError>([&] { load(replaced(plan_text, from, to)); });
    }
    static std::vector<std::string> texts(const SweepPoint& point) {
        std::vector<std::string> all;
        for (const SweepValue& value : point)
            all.push_back(value.text);
        return all;
    }
};

TEST_F(SweepPlanFile, AGridHasEveryValueWithEveryOther) {
    const SweepPlan plan = load(plan_text);
    EXPECT_EQ(plan.first_seed, 6);
    EXPECT_EQ(plan.measures[1].name, "strain_top10");
    EXPECT_EQ(plan.measures[1].at, 50.0);
    const auto points = sweep_points(plan);
    ASSERT_EQ(points.size(), 4u);
    EXPECT_EQ(texts(points[0]), (std::vector<std::string>{"0", "mat18-b"}));
    EXPECT_EQ(texts(points[1]), (std::vector<std::string>{"0", "mat18-b-calibrated"}));
    EXPECT_EQ(texts(points[3]), (std::vector<std::string>{"0.2", "mat18-b-calibrated"}));
    const Scene scene = scene_at(plan, points[3], 7);
    EXPECT_EQ(scene.seed, 7u);
    EXPECT_EQ(scene.extension.distance, 100.0);
}

TEST_F(SweepPlanFile, AListTakesValuesTogether) {
    const auto points = sweep_points(load(replaced(plan_text, "\"grid\"", "\"list\"")));
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(texts(points[1]), (std::vector<std::string>{"0.2", "mat18-b-calibrated"}));
    EXPECT_THAT(complaint("\"grid\"", "\"list\"\nsamples = 3"), HasSubstr("latin-hypercube"));
}

// Alone, a hanging wall of 10 km does not fit above an arc of 15 km.
TEST_F(SweepPlanFile, AListTriesItsPointsAndNotTheirValuesAlone) {
    const std::string depths = R"(scene = "lis1"
design = "list"
measures = []
[[vary]]
parameter = "hanging_wall.thickness_m"
values = [10000, 15000]
[[vary]]
parameter = "detachment.segments.0.arc.radius_m"
values = [10000, 15000]
)";
    EXPECT_EQ(sweep_points(load(depths)).size(), 2u);
    const std::string wrong = complaint(plan_text, replaced(depths, "[10000,", "[5000,"));
    EXPECT_THAT(wrong, HasSubstr(".toml:4: vary: run 1, hanging_wall.thickness_m=5000, "
                                 "detachment.segments.0.arc.radius_m=10000: "));
}

TEST_F(SweepPlanFile, AnIntegerHasNoRange) {
    const std::string text = replaced(plan_text, "\"grid\"", "\"latin-hypercube\"\nsamples = 4");
    EXPECT_THAT(complaint(plan_text, replaced(text, "fault_weakening.friction\"\nvalues = [0, 0.2]",
                                              "fault_weakening.angles\"\nrange = [4, 9]")),
                testing::AllOf(HasSubstr(":11: vary[0].range: "), HasSubstr("allowed: integer"),
                               HasSubstr("values = [...]")));
}

TEST_F(SweepPlanFile, PointsOfANarrowRangeDiffer) {
    std::string text = replaced(plan_text, "\"grid\"", "\"latin-hypercube\"\nsamples = 8");
    text = replaced(text, "[0, 0.2]", "[0.0100001, 0.0100002]");
    std::set<std::string> values;
    for (const SweepPoint& point : sweep_points(load(replaced(text, "values", "range"))))
        values.insert(point[0].text);
    EXPECT_EQ(values.size(), 8u);
}

TEST_F(SweepPlanFile, PointsThatMakeNoSceneAreNamed) {
    std::string text = replaced(plan_text, "fault_weakening.friction\"\nvalues = [0, 0.2]",
                                "hanging_wall.mean_radius_m\"\nvalues = [186, 1000]");
    text = replaced(text, "materials.basement\"\nvalues = [\"mat18-b\", \"mat18-b-calibrated\"]",
                    "hanging_wall.length_m\"\nvalues = [10000, 40000]");
    const SweepPlan plan = load(text);
    try {
        check_points(plan, sweep_points(plan), "plan.toml");
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr("plan.toml: run 3, hanging_wall.mean_radius_m=1000, "
                                            "hanging_wall.length_m=10000: "));
    }
}

TEST_F(SweepPlanFile, ALatinHypercubeTakesEveryPartOnce) {
    std::string text = replaced(plan_text, "\"grid\"", "\"latin-hypercube\"\nsamples = 8");
    text = replaced(text, "values = [0, 0.2]", "range = [0.0, 0.8]");
    const auto points = sweep_points(load(text));
    ASSERT_EQ(points.size(), 8u);
    std::set<int> parts;
    int calibrated = 0;
    bool sorted = true;
    for (std::size_t k = 0; k < points.size(); ++k) {
        parts.insert(static_cast<int>(*points[k][0].number / 0.1));
        calibrated += points[k][1].text == "mat18-b-calibrated";
        sorted &= k == 0 || *points[k][0].number > *points[k - 1][0].number;
    }
    EXPECT_EQ(parts, (std::set<int>{0, 1, 2, 3, 4, 5, 6, 7}));
    EXPECT_EQ(calibrated, 4);
    EXPECT_FALSE(sorted);
}

TEST_F(SweepPlanFile, BadOnesAreRefusedWithLineAndCure) {
    EXPECT_THAT(complaint("seeds = 2", "seed = 2"),
                HasSubstr(":3: seed: unknown key, did you mean"));
    EXPECT_THAT(complaint("\"grid\"", "\"gird\""), HasSubstr("grid"));
    EXPECT_THAT(complaint("seeds = 2", "seeds = 0"), HasSubstr(":3: seeds"));
    EXPECT_THAT(complaint("fault_weakening.friction", "fault_weakening.fricton"),
                HasSubstr("friction"));
    EXPECT_THAT(complaint("values = [0, 0.2]", "values = [0, -0.2]"),
                HasSubstr(":10: vary[0].values[1]"));
    EXPECT_THAT(complaint("values = [0, 0.2]", "values = []"), HasSubstr("at least one"));
    EXPECT_THAT(complaint("values = [0, 0.2]", "range = [0, 0.2]"), HasSubstr("latin-hypercube"));
    EXPECT_THAT(complaint("values = [0, 0.2]", "value = [0, 0.2]"),
                HasSubstr("did you mean values"));
    EXPECT_THAT(complaint("\"mat18-b-calibrated\"", "\"mat18-c\""), HasSubstr("mat18-b"));
    EXPECT_THAT(complaint("top10@50\"", "top10@\""), HasSubstr("extension in metres"));
    EXPECT_THAT(complaint("materials.basement\"\nvalues = [\"mat18-b\", \"mat18-b-calibrated\"]",
                          "fault_weakening.friction\"\nvalues = [0.1]"),
                HasSubstr("varied already"));
    EXPECT_THAT(complaint("scene = \"lis1\"", "scene = \"lis9\""), HasSubstr("did you mean"));
}

TEST_F(SweepPlanFile, ValuesThatMakeEqualRunsAreRefused) {
    const std::string friction = "fault_weakening.friction\"\nvalues = [0, 0.2]";
    EXPECT_THAT(complaint(friction, "seed\"\nvalues = [1, 2]"), HasSubstr("seeds and first_seed"));
    EXPECT_THAT(complaint(friction, "accuracy\"\nvalues = [\"draft\", \"fine\"]"),
                HasSubstr("beside accuracy = \"draft\""));
    EXPECT_THAT(complaint("values = [0, 0.2]", "values = [0.2, 0.2]"),
                HasSubstr(":10: vary[0].values[1]: stands twice"));
    EXPECT_THAT(complaint("seeds = 2", "seeds = 2\nwithout = \"fault_weakening bond_healing\""),
                HasSubstr("--without fault_weakening leaves out"));
    EXPECT_THAT(complaint("distance_m=100", "distance_m=100 seed=3"), HasSubstr("seed=3"));
    // A list may have a value again beside another one of the other parameter.
    const std::string list = replaced(plan_text, "\"grid\"", "\"list\"");
    EXPECT_NO_THROW(load(replaced(list, "[0, 0.2]", "[0.2, 0.2]")));
    EXPECT_THAT(complaint(plan_text, replaced(replaced(list, "[0, 0.2]", "[0.2, 0.2]"),
                                              "mat18-b-calibrated", "mat18-b")),
                HasSubstr("run 2, fault_weakening.friction=0.2, materials.basement=mat18-b makes "
                          "the same run as run 1,"));
    EXPECT_THAT(complaint("[[vary]]\nparameter = \"fault_weakening.friction\"\nvalues = [0, 0.2]\n"
                          "[[vary]]\nparameter = \"materials.basement\"\nvalues = [\"mat18-b\", "
                          "\"mat18-b-calibrated\"]\n",
                          ""),
                HasSubstr(":1: needs [[vary]]"));
}

TEST_F(SweepPlanFile, AMeasureThatNoRunCanHaveIsRefused) {
    const std::string measures = "\"strain_top10\", \"strain_top10@50\"";
    const auto refusal = [&](const std::string& name) {
        return complaint(measures, "\"" + name + "\"");
    };
    EXPECT_THAT(refusal("rollover_tlt_deg"),
                HasSubstr(":7: measures[0]: rollover_tlt_deg is no measure, did you mean "
                          "rollover_tilt_deg?"));
    EXPECT_THAT(refusal("antithetic_turn_dg@50"), HasSubstr("did you mean antithetic_turn_deg?"));
    EXPECT_THAT(refusal("antithetic_turn_deg"), HasSubstr("antithetic_turn_deg@5000"));
    EXPECT_THAT(refusal("energy_residual"), HasSubstr("a measure of [energy], which no run"));
    EXPECT_THAT(refusal("wall_s@50"), HasSubstr("at the end of a run only"));
    EXPECT_THAT(refusal("depocentres"), HasSubstr("no number"));
    for (const char* name : {"antithetic_turn_deg@50", "weak_fraction", "wall_s", "extension_m@50"})
        EXPECT_EQ(refusal(name), "accepted");
    // An effect that the plan varies is on in some of its runs.
    std::string text = replaced(plan_text, measures, "\"base_reaction_error\"");
    EXPECT_THROW(load(text), SceneError);
    text = replaced(text, "scene = \"lis1\"", "scene = \"lis1-elastic\"");
    EXPECT_NO_THROW(load(text));
}

TEST_F(SweepPlanFile, APointMayHaveSeedsOfItsOwn) {
    const auto seeds = [this](const std::string& text) {
        const SweepPlan plan = load(text);
        const auto points = sweep_points(plan);
        std::vector<std::int64_t> all;
        for (const SweepRow& row : sweep_rows(plan, points, ""))
            all.push_back(row.seed);
        return all;
    };
    EXPECT_THAT(seeds(plan_text), testing::ElementsAre(6, 7, 6, 7, 6, 7, 6, 7));
    EXPECT_THAT(seeds("own_seeds = true\n" + plan_text),
                testing::ElementsAre(6, 7, 8, 9, 10, 11, 12, 13));
}

TEST_F(SweepPlanFile, ATableIsReadAsItWasWritten) {
    const SweepPlan plan = load(plan_text);
    const auto points = sweep_points(plan);
    std::vector<SweepRow> rows{{1, 6, "finished", 0, "abc", "1.0.0+1", {0.1, std::nullopt}, ""},
                               {4, 7, "a, \"b\"", 3, "", "", {std::nullopt, std::nullopt}, ""}};
    const std::string text = to_csv(plan, points, rows);
    EXPECT_EQ(text, "run,seed,fault_weakening.friction,materials.basement,outcome,exit_code,"
                    "state_hash,made_by,strain_top10,strain_top10@50\n"
                    "1,6,0,mat18-b,finished,0,abc,1.0.0+1,0.1,\n"
                    "4,7,0.2,mat18-b-calibrated,a; 'b',3,,,,\n");
    std::ofstream(file) << text;
    EXPECT_EQ(to_csv(plan, points, read_sweep(plan, points, file)), text);
    // A word of a plan may hold what parts cells.
    auto odd = points;
    odd[3][1].text = "my, \"own\" rock.toml ";
    std::ofstream(file) << to_csv(plan, odd, rows);
    EXPECT_EQ(read_sweep(plan, odd, file).size(), 2u);
    std::ofstream(file) << text << "1,6,0\n";
    EXPECT_THROW(read_sweep(plan, points, file), UsageError);
    std::ofstream(file) << replaced(text, "0.2", "0.3");
    EXPECT_THROW(read_sweep(plan, points, file), UsageError);
    for (const char* seed : {"1,6x,", "1,6.5,", "1,,", "1,1e1,", "1,99999999999,"}) {
        std::ofstream(file) << replaced(text, "1,6,", seed);
        EXPECT_THROW(read_sweep(plan, points, file), UsageError) << seed;
    }
    for (const std::size_t cut : {1u, 2u, 4u}) { // an empty cell is no missing number
        std::ofstream(file) << text.substr(0, text.size() - cut);
        EXPECT_THROW(read_sweep(plan, points, file), StorageError) << cut;
    }
    const std::string earlier = replaced(replaced(text, "made_by,", ""), "1.0.0+1,", "");
    std::ofstream(file) << earlier;
    EXPECT_THAT([&] { read_sweep(plan, points, file); },
                testing::ThrowsMessage<UsageError>(HasSubstr("an earlier version made it")));
}

/// Four factors of two values, each point by `seeds` seeds.
struct MadeTable {
    std::vector<SweepFactor> factors;
    std::vector<std::size_t> point;
    std::vector<int> seed;
    std::vector<std::optional<double>> value;
};

/// With known effects and differences of seeds.
MadeTable made_table(int seeds) {
    MadeTable t;
    for (const char* name : {"a", "b", "c", "d"})
        t.factors.push_back({name, {}});
    for (std::size_t p = 0; p < 16; ++p)
        for (int s = 1; s <= seeds; ++s) {
            double x[4];
            for (std::size_t f = 0; f < 4; ++f)
                t.factors[f].place.push_back(x[f] = (p >> f & 1) ? 1.0 : -1.0);
            t.point.push_back(p);
            t.seed.push_back(s);
            t.value.emplace_back(7.0 + 1.5 * x[0] - 0.5 * x[1] + 1.0 * x[0] * x[2] + 4.0 * s);
        }
    return t;
}

std::vector<SweepEffect> effects(const MadeTable& t) {
    return effects_on("y", t.factors, t.point, t.seed, t.value);
}

double expected(const std::string& term) {
    return term == "a" ? 3.0 : term == "b" ? -1.0 : term == "a:c" ? 2.0 : 0.0;
}

TEST_F(SweepPlanFile, MoreRunsThanAnybodyMakesAreRefusedBeforeTheyTakeMemory) {
    const auto said = [&](const std::string& text) { return complaint(plan_text, text); };
    const std::string hypercube =
        replaced(replaced(replaced(plan_text, "\"grid\"", "\"latin-hypercube\"\nsamples = 100000"),
                          "seeds = 2", "seeds = 1000"),
                 "values = [0, 0.2]", "range = [0.0, 0.2]");
    EXPECT_THAT(said(hypercube), HasSubstr(":6: samples: makes 100000000 runs, 100000 points "
                                           "with 1000 seeds each; allowed: at most 100000"));
    std::string many = "0.1";
    for (int k = 0; k < 100; ++k)
        many += ", 0.1";
    const std::string list =
        replaced(replaced(replaced(plan_text, "\"grid\"", "\"list\""), "seeds = 2", "seeds = 1000"),
                 "0, 0.2", many);
    EXPECT_THAT(said(list), HasSubstr(":3: seeds: makes 101000 runs"));
    const std::string grid =
        replaced(replaced(plan_text, "seeds = 2", "seeds = 1000"), "0, 0.2", many);
    EXPECT_THAT(said(grid), HasSubstr(":3: seeds: makes 202000 runs"));
}

TEST_F(SweepPlanFile, AValueThatMakesARunTooLargeIsRefused) {
    const std::string text = replaced(
        replaced(plan_text, "fault_weakening.friction", "sedimentation.level_m"), "0.2]", "90000]");
    EXPECT_THAT(
        complaint(plan_text, text),
        HasSubstr("values[1]: sedimentation.level_m: 90000 makes a run that fills the basin"));
}

TEST(SweepEffects, KnownOnesAreFound) {
    const auto found = effects(made_table(2));
    ASSERT_EQ(found.size(), 10u); // four and six
    for (const SweepEffect& e : found) {
        EXPECT_NEAR(e.effect, expected(e.term), 1e-12) << e.term;
        EXPECT_NEAR(e.standard_error.value(), 0.0, 1e-12);
    }
}

TEST(SweepEffects, AFailedRunDoesNotBiasThem) {
    MadeTable t = made_table(2);
    t.value[3] = t.value[10] = std::nullopt;
    for (const SweepEffect& e : effects(t))
        EXPECT_NEAR(e.effect, expected(e.term), 1e-12) << e.term;
}

TEST(SweepFactors, ValuesThatGoUpByFactorsCountByTheirLogarithm) {
    const auto places = [](const std::vector<double>& numbers) {
        SweepPlan plan;
        plan.parameters.emplace_back().name = "a";
        std::vector<SweepPoint> points;
        std::vector<SweepRow> rows;
        for (const double number : numbers) {
            points.push_back({{std::to_string(number * 1e12), {}, number}});
            rows.push_back({.run = points.size()});
        }
        return factors_of(plan, points, rows).at(0).place;
    };
    EXPECT_THAT(places({1e-10, 1e-9, 1e-8}),
                testing::Pointwise(testing::DoubleNear(1e-12), {-1.0, 0.0, 1.0}));
    EXPECT_NEAR(places({0.001, 0.1, 0.2})[1], -0.00503, 1e-4); // listed by differences
    std::vector<double> samples; // of 0 to 0.5, as a hypercube has them
    for (int k = 0; k < 100; ++k)
        samples.push_back(0.005 * (k + 0.5));
    EXPECT_NEAR(places(samples)[50], 1.0 / 99.0, 1e-12);
}

// The measure loses its values from one end of a on.
TEST(SweepEffects, NoneReachesBeyondTheValuesOfItsMeasure) {
    const std::vector<double> a{-1.0, -0.5, 0.0, 0.5, 1.0};
    const auto terms = [&](double last) {
        std::vector<SweepFactor> factors{{"a", {}}, {"b", {}}};
        std::vector<std::size_t> point;
        std::vector<std::optional<double>> values;
        for (const double b : {-1.0, 1.0})
            for (const double place : a) {
                factors[0].place.push_back(place);
                factors[1].place.push_back(b);
                point.push_back(point.size() + 1);
                values.push_back(place <= last ? std::optional(3.0 * place + b) : std::nullopt);
            }
        std::vector<std::string> told;
        const std::vector<int> seed(point.size(), 1);
        for (const SweepEffect& e : effects_on("y", factors, point, seed, values))
            told.push_back(e.term);
        return told;
    };
    EXPECT_EQ(terms(1.0), (std::vector<std::string>{"a", "b", "a:b"}));
    EXPECT_EQ(terms(0.5), (std::vector<std::string>{"a", "b", "a:b"})); // three quarters are left
    EXPECT_EQ(terms(0.0), std::vector<std::string>{"b"});
    EXPECT_TRUE(terms(-0.5).empty()); // b is told in the middle of a
}

TEST(SweepEffects, OneSeedHasNoError) {
    const auto found = effects(made_table(1));
    ASSERT_FALSE(found.empty());
    EXPECT_FALSE(found[0].standard_error || found[0].p || found[0].margin_95);
}

TEST(SweepEffects, OfTwoValuesAndTwoSeedsOneDifferenceIsLeft) {
    // Means 2 and 4; what is left of each run about its point and seed is a quarter of 0.4.
    const std::vector<SweepFactor> factors{{"a", {-1.0, -1.0, 1.0, 1.0}}};
    const std::vector<std::optional<double>> values{1.0, 3.0, 3.2, 4.8};
    const auto found = effects_on("y", factors, std::vector<std::size_t>{1, 1, 2, 2},
                                  std::vector{1, 2, 1, 2}, values);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].effect, 2.0, 1e-12);
    EXPECT_EQ(found[0].degrees_of_freedom, 1);
    EXPECT_NEAR(found[0].standard_error.value(), 0.2, 1e-12);
    // Ten standard errors, and still one of sixteen sweeps without any effect has as much.
    EXPECT_NEAR(found[0].p.value(), 0.0634510, 1e-6);
    EXPECT_NEAR(found[0].margin_95.value(), 2.5412410, 1e-6);
}

TEST(SweepEffects, RoundOffIsNoEffect) {
    MadeTable t = made_table(2);
    for (std::size_t k = 0; k < t.value.size(); ++k)
        t.value[k] = 0.1 + (k % 3 == 0 ? 1e-17 : 0.0);
    for (const SweepEffect& e : effects(t))
        EXPECT_EQ(e.p, 1.0) << e.term;
}

TEST(SweepEffects, WhatCannotBeToldApartIsLeftOut) {
    MadeTable t = made_table(2);
    t.factors[3].place = t.factors[1].place; // b and d always together
    std::set<std::string> terms;
    for (const SweepEffect& e : effects(t))
        terms.insert(e.term);
    EXPECT_EQ(terms, (std::set<std::string>{"a", "c", "a:c"}));
}

TEST(SweepEffects, WordsWithoutOrderDoNotBiasOthers) {
    MadeTable t = made_table(2);
    t.factors[1].word.resize(t.point.size());
    for (std::size_t k = 0; k < t.point.size(); ++k) {
        const std::size_t word = t.point[k] % 3;
        t.factors[1].word[k] = word;
        *t.value[k] += 0.5 * t.factors[1].place[k]; // undoes b's own effect
        *t.value[k] += word == 0 ? 5.0 : word == 1 ? -2.0 : 1.0;
    }
    for (const SweepEffect& e : effects(t)) {
        EXPECT_NEAR(e.effect, expected(e.term), 1e-10) << e.term;
        EXPECT_NE(e.term[0], 'b');
    }
}

} // namespace

} // namespace listric::sweep_test
