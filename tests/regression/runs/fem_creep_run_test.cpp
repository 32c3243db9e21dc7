// Scenes whose footwall relaxes: the same bits however they are cut, none where it does not, and
// what bad input leads to.

#include "apps/commands/explain.hpp"
#include "apps/model/effects/elastic_base_parameters.hpp"
#include "apps/support/error.hpp"
#include "coupling/base_memory.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <fstream>

namespace listric::fem_creep_run_test {

using namespace dem;
using namespace coupling;
namespace {

using nlohmann::json;
using namespace support;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// 400 discs on a crust of 5 km; 60 m out, a pause of 4 Ma in two steps, 30 m out.
const std::string scene = small_halfgraben() + R"([extension]
rate_m_per_a = 0.001
speed_m_per_s = 1.0
[[stage]]
distance_m = 60.0
[[stage]]
pause_a = 4e6
step_a = 2e6
settle_m = 50.0
[[stage]]
distance_m = 30.0
[output]
interval_m = 50.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
)" + small_elastic_base();
const std::string viscous = "layers = [{top_depth_m = 0.0, viscosity_pa_s = 1e23},"
                            "{top_depth_m = 3000.0, viscosity_pa_s = 1e21}]\n";
const std::string strong = "elastic_thickness_m = 5000.0\n";
const std::string loads = R"([lower_crust_thinning]
thickness_m = 20000.0
width_m = 15000.0
centre_m = 1500.0
[footwall_erosion]
interval_a = 20000.0
width_m = 20000.0
[basin_water]
)";

class CreepRun : public SceneRuns {
protected:
    std::string refusal(const std::string& more, const std::vector<std::string>& set = {}) const {
        try {
            load(scene + more, set);
        } catch (const SceneError& error) {
            return error.what();
        }
        return "";
    }
};

/// Cut in the pause, whose stiffness is another, and after it. 10 s.
TEST_F(CreepRun, EndsInTheSameBitsHoweverItIsCut) {
    const Scene s = load(scene + viscous + loads);
    const json whole = run(s, "whole");
    for (const double until : {70.0, 175.0}) {
        run(s, "parts", until);
        EXPECT_EQ(run(s, "parts", {}, true)["state_hash"], whole["state_hash"]) << until;
    }
    EXPECT_EQ(run(s, "threads", {}, false, 2)["state_hash"], whole["state_hash"]);
    std::printf("base: elements %.4f, resolved %.4f, uplift %.3f m\n",
                whole["base_elements_difference"].get<double>(),
                whole["base_resolved_difference"].get<double>(),
                whole["footwall_uplift_m"].get<double>());
    EXPECT_LT(whole["base_elements_difference"].get<double>(), 0.05); // as without viscosity

    const State end = read_snapshot(list_snapshots(folder / "whole").back()).state;
    EXPECT_FALSE(creep_stress(end).empty());
    EXPECT_NEAR(creep_step(end).value() / seconds_per_year, 25e3, 1.0);
}

TEST_F(CreepRun, WithoutViscosityLayersAreTheBaseOfBefore) {
    const json none = run(load(scene + strong), "none");
    const json layers = run(load(scene + strong + "layers = [{top_depth_m = 0.0}]\n"), "layers");
    EXPECT_EQ(layers["state_hash"], none["state_hash"]);
    const State end = read_snapshot(list_snapshots(folder / "layers").back()).state;
    EXPECT_TRUE(creep_stress(end).empty() && !creep_step(end));
    for (const auto& [name, table] : end.base_memory)
        EXPECT_THAT(name, Not(HasSubstr("creep")));
}

TEST_F(CreepRun, IsWrittenAndReadBack) {
    const Scene s = load(scene + viscous);
    const auto& base = *s.find<ElasticBaseParameters>();
    EXPECT_EQ(base.layers[1].viscosity, 1e21);
    EXPECT_EQ(base.bending.elastic_thickness, base.depth); // viscosity alone says what flows
    EXPECT_EQ(base.modes, 0);
    EXPECT_EQ(to_toml(load(to_toml(s))), to_toml(s));
    EXPECT_THAT(to_toml(load(scene + strong + "layers = [{top_depth_m = 0.0}]\n")),
                Not(HasSubstr("viscosity_pa_s = ")));
}

TEST_F(CreepRun, RefusesWhatContradictsItself) {
    EXPECT_EQ(refusal(viscous), "");
    EXPECT_EQ(refusal(viscous + "elastic_thickness_m = 4000.0\n"), "");
    EXPECT_THAT(refusal(viscous + "elastic_thickness_m = 3000.0\n"),
                AllOf(HasSubstr("small.toml:"), HasSubstr("elastic_base.layers[1].viscosity_pa_s"),
                      HasSubstr("is 1e21 in a layer from 3000"),
                      HasSubstr("elastic_thickness_m = 3000"), HasSubstr("raise")));
    EXPECT_THAT(refusal(viscous + "modes = 50\n"),
                AllOf(HasSubstr("small.toml:"), HasSubstr("elastic_base.modes"),
                      HasSubstr("give 0 or leave it out")));
    EXPECT_EQ(refusal(viscous + "modes = 0\n"), "");
    for (const std::string value : {"0.0", "-1e21", "nan", "1e40"})
        EXPECT_THAT(refusal("layers = [{top_depth_m = 0.0, viscosity_pa_s = " + value + "}]\n"),
                    AllOf(HasSubstr("small.toml:"),
                          HasSubstr("elastic_base.layers[0].viscosity_pa_s"), HasSubstr("1e16")))
            << value;
}

TEST_F(CreepRun, ExplainTellsTimesAndSteps) {
    const std::string text = explain(load(scene + viscous), 1, program_effects());
    EXPECT_THAT(text, AllOf(HasSubstr("relaxes from 0 km down (1e+23 Pa s): by 63 % in 113 kyr"),
                            HasSubstr("a step of 25 kyr: 0.221 of these times"),
                            HasSubstr("a step of 1 Myr"), HasSubstr("MB in a snapshot")));
    EXPECT_THAT(explain(load(scene + strong), 1, program_effects()),
                Not(HasSubstr("relaxes from")));
}

} // namespace

} // namespace listric::fem_creep_run_test
