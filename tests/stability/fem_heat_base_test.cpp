// Temperatures and a base that bends: how they load it, where its strength ends by them, and what
// is refused.

#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/commands/explain.hpp"
#include "apps/model/effects.hpp"
#include "apps/support/error.hpp"
#include "tests/message_of.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace listric::fem_heat_base_test {

using namespace dem;
namespace {

using namespace support;
using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

/// A rift that stretches by a third at once and rests for 8 Ma. 400 discs.
const std::string scene = small_halfgraben() + R"([extension]
distance_m = 860.0
speed_m_per_s = 4.0
[output]
interval_m = 60.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
[sedimentation]
interval_a = 2000.0
[compaction]
)" + small_elastic_base() +
                          R"([lower_crust_thinning]
thickness_m = 2000.0
width_m = 15000.0
centre_m = 1500.0
[[stage]]
distance_m = 60.0
[[stage]]
pause_a = 8e6
step_a = 2e6
)";
const std::string heat = R"([heat]
interval_a = 2000.0
regional_extension_m = 5000.0
)";

class HeatBaseRun : public SceneRuns {
protected:
    Scene load(const std::string& more, const std::vector<std::string>& set) const {
        return SceneRuns::load(scene + more, set);
    }
    std::string refusal(const std::vector<std::string>& set, const std::string& more = heat) const {
        return message_of<SceneError>([&] { load(more, set); });
    }
    void expect_the_same_bits(const Scene& s, double until) const {
        const json whole = run(s, "whole");
        run(s, "parts", until);
        EXPECT_EQ(run(s, "parts", {}, true)["state_hash"], whole["state_hash"]);
        EXPECT_EQ(run(s, "threads", {}, false, 2)["state_hash"], whole["state_hash"]);
        EXPECT_LT(whole["thermal_load_n_per_m"].get<double>(), -1e9);
        EXPECT_NE(whole["post_rift_subsidence_m"].get<double>(), 0.0); // with what the base lags
        EXPECT_GT(whole["film_load_n_per_m"].get<double>(), 1e6);
    }
    State last_state(const std::string& name) const {
        return read_snapshot(list_snapshots(folder / name).back()).state;
    }
    /// Whether the base goes at once to where a step's loads move it.
    bool is_prompt(const std::string& name) const {
        return read_snapshot(list_snapshots(folder / name).back())
            .event_memory.contains("prompt_base");
    }
};

TEST_F(HeatBaseRun, HasTheSameBitsHoweverItIsRun) {
    expect_the_same_bits(load(heat, {"elastic_base.elastic_thickness_m=1000"}), 400.0);
    EXPECT_TRUE(is_prompt("whole"));
}

TEST_F(HeatBaseRun, HasTheSameBitsWithAnIsotherm) {
    const Scene s =
        load(heat, {"elastic_base.elastic_isotherm_c=90", "heat.regional_extension_m=15000"});
    expect_the_same_bits(s, 750.0);   // it has moved after 660 m
    EXPECT_FALSE(is_prompt("whole")); // its stiffness changes
    const State end = last_state("whole");
    const Table& line = end.base_memory.at("isotherm");
    EXPECT_GT(line.get<double>("since")[0], 500.0);
    EXPECT_GT(line.rows(), 2u);
}

/// Without expansion temperatures move nothing. (A stage that fills has a film of sediment.)
TEST_F(HeatBaseRun, LoadsByExpansionAlone) {
    const std::vector<std::string> thin{"elastic_base.elastic_thickness_m=1000",
                                        "extension.distance_m=60",
                                        "stage=[{distance_m=60.0,sedimentation=\"none\"}]"};
    std::vector<std::string> none = thin;
    none.insert(none.end(), {"heat.thermal_expansion_per_k=0", "heat.regional_extension_m=0"});
    const json still = run(load(heat, none), "none");
    EXPECT_EQ(still["thermal_load_n_per_m"].get<double>(), 0.0);
    run(load("", thin), "cold");
    run(load(heat, thin), "hot");
    const State without = last_state("none"), cold = last_state("cold"), hot = last_state("hot");
    EXPECT_THAT(disc_columns(without).y, testing::ElementsAreArray(disc_columns(cold).y));
    EXPECT_NE(base_node_columns(hot).uy[0], base_node_columns(cold).uy[0]);
}

TEST_F(HeatBaseRun, RefusesWhatCannotBe) {
    EXPECT_THAT(
        refusal({"elastic_base.elastic_isotherm_c=90", "elastic_base.elastic_thickness_m=1000"}),
        AllOf(HasSubstr("elastic_isotherm_c: is 90 beside elastic_thickness_m = 1000"),
              HasSubstr("leave one out")));
    EXPECT_THAT(refusal({"elastic_base.elastic_isotherm_c=90"}, ""),
                HasSubstr("elastic_isotherm_c: is 90, but rock has no temperatures"));
    EXPECT_THAT(refusal({"elastic_base.elastic_isotherm_c=450"}),
                AllOf(HasSubstr("elastic_isotherm_c: is 450"), HasSubstr("depth_m = 5000")));
    EXPECT_THAT(refusal({"elastic_base.elastic_isotherm_c=90", "elastic_base.modes=20"}),
                HasSubstr("elastic_base.modes: is 20 beside elastic_isotherm_c"));
    EXPECT_THAT(refusal({"elastic_base.elastic_isotherm_c=90",
                         "elastic_base.layers=[{top_depth_m=0.0, viscosity_pa_s=1e23}]"}),
                HasSubstr("beside a layer with viscosity_pa_s"));
    EXPECT_THAT(
        refusal({"elastic_base.asthenosphere_density_kg_per_m3=2600"}),
        AllOf(HasSubstr("crust_density_kg_per_m3: is 2700"), HasSubstr("asthenosphere (2600)")));
    EXPECT_THAT(refusal({"stage=[{pause_a=1e4}]", "extension.distance_m=100"}),
                HasSubstr("heat.regional_extension_m: is 5000 and goes with the wall's way out"));
}

TEST_F(HeatBaseRun, WarnsOfMantleThatStretchesBeyondTheFootwall) {
    const auto warnings = [&](const std::string& width) {
        return load(heat, {"elastic_base.elastic_thickness_m=1000", "heat.mantle_width_m=" + width})
            .warnings;
    };
    EXPECT_THAT(warnings("60e3"), Contains(AllOf(HasSubstr("mantle stretches from x = -6000 to"),
                                                 HasSubstr("ends at -40000 and 50000"))));
    EXPECT_THAT(warnings("30e3"), testing::Not(Contains(HasSubstr("mantle stretches"))));
}

TEST_F(HeatBaseRun, ExplainsWhatSubsides) {
    const CycleSpeed speed{.team = 1e7, .one_thread = 1e7};
    const std::string text =
        explain(load(heat, {"elastic_base.elastic_isotherm_c=90"}), speed, 1, program_effects());
    EXPECT_THAT(text, AllOf(HasSubstr("stretched by 1.34 and 1.34 at the end"),
                            HasSubstr("layers of discs"), HasSubstr("up to 120 m below the target"),
                            HasSubstr("weighs on the base and is a blanket"),
                            HasSubstr("Te is the depth of 90 degC")));
}

} // namespace
} // namespace listric::fem_heat_base_test
