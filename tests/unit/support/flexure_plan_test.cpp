// Plans of flexure: what they may have, and that they read back the same.

#include "apps/studies/flexure_plan.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <unistd.h>

namespace listric::flexure_plan_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

class FlexurePlans : public testing::Test {
protected:
    FlexurePlans() { fs::create_directories(folder_); }
    ~FlexurePlans() override { fs::remove_all(folder_); }

    FlexurePlan load(const std::string& text) const {
        write_text(file_, text);
        return load_flexure_plan({.scene = file_.string()});
    }

    std::string error(const std::string& text) const {
        try {
            load(text);
        } catch (const SceneError& error) {
            return std::string(error.what()).substr(folder_.string().size() + 1);
        }
        return "no error";
    }

    const fs::path folder_ =
        fs::temp_directory_path() / ("listric-plan-" + std::to_string(getpid()));
    const fs::path file_ = folder_ / "plan.toml";
};

TEST_F(FlexurePlans, OneIsShippedAndFoundByItsName) {
    EXPECT_TRUE(is_flexure_plan("flexure"));
    for (const char* other : {"lis1", "isostasy", "flexur", "/nowhere.toml", ""})
        EXPECT_FALSE(is_flexure_plan(other)) << other;
    const FlexurePlan plan = load_flexure_plan({.scene = "flexure"});
    EXPECT_EQ(plan.name, "flexure");
    EXPECT_EQ(plan.bending().elastic_thickness, 10e3);
    EXPECT_EQ(plan.gravity, 9.81);
}

TEST_F(FlexurePlans, AFormerKeyIsPassedOverAsInScenes) {
    const std::string plan = "[flexure]\n[elastic_base]\nscheme = ";
    EXPECT_EQ(to_toml(load(plan + "'modal'\n")), to_toml(load("[flexure]\n")));
    EXPECT_EQ(error(plan + "'lumped'\n").find("plan.toml:3: elastic_base.scheme: "), 0u);
}

TEST_F(FlexurePlans, ReadBackTheSame) {
    const FlexurePlan plan = load_flexure_plan(
        {.scene = "flexure",
         .set = {"name=a \"b\"", "flexure={load = 'strip', half_width_m = 12345.678901}",
                 "gravity.acceleration_m_per_s2=3.7", "elastic_base.elastic_thickness_m=1234.5",
                 "elastic_base.solver=gamg"},
         .accuracy = "draft",
         .seed = std::numeric_limits<std::int64_t>::max()});
    EXPECT_EQ(plan.gravity, 3.7);
    EXPECT_EQ(plan.bending().solver, fem::Solver::gamg);
    EXPECT_EQ(to_toml(load(to_toml(plan))), to_toml(plan));
}

TEST_F(FlexurePlans, NeedALoadAndNothingElse) {
    EXPECT_EQ(error("[flexure]\n"), "no error");
    EXPECT_EQ(error("[flexure]\n[elastic_base]\n[gravity]\n"), "no error");
    EXPECT_THAT(error("[elastic_base]\n"), StartsWith("plan.toml:1: flexure: is missing"));
    EXPECT_THAT(error("[bonds]\n"), StartsWith("plan.toml:1: flexure: is missing"));
}

TEST_F(FlexurePlans, RefuseWhatTheyCannotHave) {
    EXPECT_THAT(error("[flexure]\n[bonds]\n"), StartsWith("plan.toml:2: bonds: needs discs"));
    EXPECT_THAT(error("[flexure]\n[materials]\n"),
                StartsWith("plan.toml:2: materials: needs discs"));
    EXPECT_THAT(error("[flexure]\n[gravty]\n"), HasSubstr("did you mean gravity?"));
    EXPECT_THAT(error("[flexure]\nlaod = 'line'\n"), HasSubstr("did you mean load?"));
    EXPECT_THAT(error("name = 'a/b'\n[flexure]\n"), StartsWith("plan.toml:1: name: "));
    EXPECT_THROW(load_flexure_plan({.scene = "flexure", .without = {"elastic_base"}}), SceneError);
}

TEST_F(FlexurePlans, RefuseWhatMakesNoSense) {
    const auto refusal = [&](const std::string& keys) { return error("[flexure]\n" + keys); };
    EXPECT_THAT(refusal("[elastic_base]\npoisson_ratio = 0.5\n"), HasSubstr("below 0.5"));
    EXPECT_THAT(refusal("[elastic_base]\nyoung_modulus_pa = -1.0\n"), HasSubstr("at least 1e6"));
    EXPECT_THAT(refusal("[elastic_base]\nmantle_density_kg_per_m3 = 2000.0\n"),
                StartsWith("plan.toml:2: elastic_base.crust_density_kg_per_m3: is 2700"));
    EXPECT_THAT(refusal("load = 'lin'\n"), HasSubstr("did you mean line?"));
    EXPECT_THAT(refusal("load = 'strip'\nhalf_width_m = 10.0\n"),
                StartsWith("plan.toml:3: flexure.half_width_m: too short"));
}

TEST_F(FlexurePlans, ExplainIsFiniteAtTheEndsOfRanges) {
    const FlexurePlan shipped = load_flexure_plan({.scene = "flexure"});
    for (const Parameter& parameter : shipped.base.effect->parameters) {
        if (!std::holds_alternative<Place<double>>(parameter.value))
            continue;
        for (const double end : {std::max(parameter.range.from, parameter.range.above),
                                 std::min(parameter.range.to, parameter.range.below)}) {
            const std::string set = std::string(shipped.base.effect->name) + '.' +
                                    std::string(parameter.key) + '=' + std::to_string(end);
            try {
                EXPECT_THAT(explain(load_flexure_plan({.scene = "flexure", .set = {set}})),
                            testing::Not(testing::ContainsRegex("[^a-z](inf|nan)[^a-z]")))
                    << set;
            } catch (const SceneError&) {
                continue; // is not in the range, or does not go with the rest
            }
        }
    }
}

} // namespace
} // namespace listric::flexure_plan_test
