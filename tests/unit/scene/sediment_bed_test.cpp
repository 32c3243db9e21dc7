// Beds of sediment: which stratum is of which, and what their tables become.

#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/parameters/sediment_bed.hpp"
#include "apps/scene/scene.hpp"
#include "apps/scene/scene_file.hpp"
#include "dem/beds.hpp"
#include "fluid/pore_law.hpp"

#include <gtest/gtest.h>

namespace listric::sediment_bed_test {

using namespace dem;
namespace {

TEST(SedimentBed, AStratumIsOfTheBedInWhichItEnds) {
    const Beds beds{{{3e4, {0.6, 5e-4}}, {5e4, {0.5, 3e-4}}, {1e99, {0.4, 2e-4}}},
                    Schedule(1e4, 0.01)};
    const std::size_t of[] = {0, 0, 0, 0, 1, 1, 2, 2};
    for (std::int32_t stratum = 1; stratum < 8; ++stratum)
        EXPECT_EQ(beds.of(stratum), of[stratum]) << stratum;
    EXPECT_EQ(beds.law(5, {}).surface_porosity, 0.5);
    EXPECT_EQ(Beds{}.of(7), 0u);
    EXPECT_EQ(Beds{}.law(7, {0.3, 1e-4}).surface_porosity, 0.3);
}

ModelParts parts_of(const std::string& beds) {
    return make_parts(load_scene({.scene = "lis1-mud", .set = {"bed=" + beds}}));
}

TEST(SedimentBed, HasItsMaterialsPoresAndWhatItSays) {
    const ModelParts parts = parts_of(
        R"([{material="sand", until_a=2e5, permeability_m2=1e-15}, {permeability_ratio=4.0}])");
    const SedimentFacts& sediment = *parts.sediment;
    EXPECT_EQ(sediment.beds.list[0].pores.surface_porosity, 0.49);
    EXPECT_EQ(sediment.beds.list[0].pores.coefficient, 0.27e-3);
    EXPECT_EQ(sediment.flows[0].permeability.at_fifth, 1e-15);
    EXPECT_EQ(sediment.beds.list[1].pores.surface_porosity, sediment.surface_porosity);
    EXPECT_EQ(sediment.flows[1].permeability.at_fifth, 1e-18);
    EXPECT_EQ(sediment.flows[1].ratio, 4.0);
}

TEST(SedimentBed, SpecificSurfaceIsKozenyAndCarmans) {
    const double surface = 2e7, porosity = 0.35;
    const auto flow = parts_of("[{specific_surface_per_m=2e7}]").sediment->flows[0];
    const double k = porosity * porosity * porosity /
                     (5.0 * surface * surface * (1.0 - porosity) * (1.0 - porosity));
    EXPECT_NEAR(fluid::permeability(flow.permeability, porosity), k, 1e-12 * k);
}

TEST(SedimentBed, LaminaeLieInSeriesAndSideBySide) {
    const Scene scene =
        load_scene({.scene = "lis1-mud",
                    .set = {R"(bed=[{material="sand", laminae="mud", laminae_share=0.25}])"}});
    const SedimentFacts sediment = *make_parts(scene).sediment;
    const double across = 1.0 / (0.75 / 1e-14 + 0.25 / 1e-18), along = 0.75e-14 + 0.25e-18;
    EXPECT_NEAR(sediment.flows[0].permeability.at_fifth, across, 1e-12 * across);
    EXPECT_NEAR(sediment.flows[0].ratio, along / across, 1e-12 * along / across);
    EXPECT_NEAR(sediment.beds.list[0].pores.surface_porosity, 0.75 * 0.49 + 0.25 * 0.63, 1e-12);
    EXPECT_NE(to_toml(scene).find("permeability_ratio"), std::string::npos); // stands alone
}

TEST(SedimentBed, WarnsOfARatioThatLeaks) {
    const auto warnings = [](const std::string& ratio) {
        std::string all;
        for (const std::string& one :
             load_scene({.scene = "lis1-mud",
             .set = {"bed=[{name=\"shale\", permeability_ratio=" + ratio + "}]"}})
                 .warnings)
            all += one;
        return all;
    };
    EXPECT_EQ(warnings("1e4").find("shale"), std::string::npos);
    EXPECT_NE(warnings("1e5").find("bed: shale conducts 1e+05 times as much along as across"),
              std::string::npos);
}

} // namespace
} // namespace listric::sediment_bed_test
