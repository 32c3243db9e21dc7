// Measures of inversion on sections that are known: a raised slab, a rollover with a graben, strata
// that shortening has lifted by what they had sunk.

#include "apps/model/effects/stage/measures.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace listric::inversion_test {

using namespace dem;
using namespace effects::stage;
namespace {

using support::Disc;
using support::make_state;

constexpr double radius = 50.0, width = 100.0; // m, of a column

TargetLine level(double y) { return TargetLine({{0.0, y}}); }

/// Discs in columns, each with its top at a height, m.
template <class Top> State section(double from, double to, Top&& top) {
    std::vector<Disc> discs;
    for (double x = from + 0.5 * width; x < to; x += width)
        for (int k = 0; k < 3; ++k)
            discs.push_back({.x = x, .y = top(x) - radius - 2.0 * radius * k, .radius = radius});
    State state = make_state(discs);
    state.mean_radius = radius;
    return state;
}

TEST(Inversion, AreaAboveTheRegionalIsThatOfARaisedSlab) {
    const State state = section(-2e3, 10e3, [](double x) { return x < 4e3 ? 300.0 : -200.0; });
    EXPECT_NEAR(area_above_regional(state, level(0.0)), 6e3 * 300.0, width * 300.0);
    EXPECT_NEAR(area_above_regional(state, level(-200.0)), 6e3 * 500.0, width * 500.0);
    EXPECT_EQ(area_above_regional(state, level(400.0)), 0.0);
}

TEST(Inversion, RegionalIsTheTargetLineWhenShorteningBegins) {
    Motion motion{1.0, 0.0};
    motion.stages = {{.start = Travel(0.0), .end = Travel(5000.0)},
                     {.start = Travel(5000.0),
                      .end = Travel(9000.0),
                      .start_position = Extension(5000.0),
                      .slope = -1.0}};
    const Target target(0.0, {{0.0, {{0.0, 0.0}}},
                              {1e6, {{0.0, 0.0}, {10e3, -400.0}}}}); // twice as late, at 0.01 m/a
    const TargetLine regional = regional_of(motion, target, 0.01);
    EXPECT_NEAR(regional.height(0.0), 0.0, 1e-9);
    EXPECT_NEAR(regional.height(10e3), -200.0, 1e-9);
    // Ground that lies on it is not above it.
    const State state = section(0.0, 10e3, [](double x) { return -0.02 * x; });
    EXPECT_NEAR(area_above_regional(state, regional), 0.0, 0.02 * width * 10e3);
    EXPECT_NEAR(area_above_regional(state, level(-200.0)), 0.5 * 10e3 * 200.0, 1e4);
}

TEST(Inversion, ReliefIsTheFallFromTheCrestIntoTheGraben) {
    // From 3 km below the breakaway up to the crest at 12 km, a graben 800 m deep from 18 to 26 km.
    const auto top = [](double x) {
        if (x < 12e3)
            return -3000.0 * (1.0 - x / 12e3);
        return x > 18e3 && x < 26e3 ? -800.0 : 0.0;
    };
    EXPECT_NEAR(graben_relief(section(0.0, 40e3, top)), 800.0, 1.0);
    EXPECT_NEAR(graben_relief(section(0.0, 40e3, [](double x) { return 0.1 * x; })), 0.0, 1e-9);
}

TEST(Inversion, ReliefIsNoneOfAColumnThatTheWallCuts) {
    // Beside the wall half a column, in which a disc lies 10 km deep and none above it. Many sizes:
    // rounding must not make a column of its own of it.
    for (double r = 40.0; r < 60.0; r += 0.37) {
        std::vector<Disc> discs;
        for (int k = 0; k < 200; ++k)
            discs.push_back({.x = 7.3 + 2.0 * r * k, .y = -r, .radius = r});
        discs.push_back({.x = 7.3 + 2.0 * r * 200.5, .y = -10e3, .radius = r});
        State state = make_state(discs);
        state.mean_radius = r;
        EXPECT_NEAR(graben_relief(state), 0.0, 1e-9) << r;
    }
}

TEST(Inversion, NullPointIsWhereStrataAreBackAtTheRegional) {
    // Ten strata, each laid down at the regional, at 500, 1000, ... 5000 m of extension; each
    // metre of extension has let those that were there sink by 0.5 m, and 2.2 km of shortening
    // have lifted all of them. Tops at the regional: those of 5000 - 2200 m.
    const double extension = 5000.0, shortening = 2200.0, sinks = 0.5;
    std::vector<Disc> discs;
    std::vector<double> at;
    for (int stratum = 1; stratum <= 10; ++stratum)
        for (double x = 150.0; x < 1600.0; x += width) {
            const double deposited = 500.0 * stratum;
            discs.push_back({.x = x,
                             .y = sinks * (shortening - (extension - deposited)) - radius,
                             .radius = radius});
            at.push_back(deposited);
        }
    State state = make_state(discs);
    state.mean_radius = radius;
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < at.size(); ++i) {
        d.start_travel[i] = at[i];
        d.stratum[i] = static_cast<std::int32_t>(std::lround(at[i] / 500.0));
    }
    Motion motion{1.0, 0.0};
    motion.stages = {{.start = Travel(0.0), .end = Travel(5000.0)},
                     {.start = Travel(5000.0),
                      .end = Travel(9000.0),
                      .start_position = Extension(5000.0),
                      .slope = -1.0}};
    EXPECT_NEAR(null_point(state, motion, level(0.0), Travel(5000.0)).value(), 2800.0, 1e-6);
    EXPECT_FALSE(null_point(state, motion, level(-5000.0), Travel(5000.0))); // all tops are above
    EXPECT_FALSE(null_point(state, motion, level(5000.0), Travel(5000.0)));
    // The pre-rift top is the oldest: where it is at the regional again, or above, all that was
    // extended is taken back. It lies between where it was, and the oldest stratum.
    State all = state;
    const std::size_t first = add_discs(all, 14);
    for (std::size_t k = 0; k < 14; ++k) {
        const DiscColumns c = disc_columns(all);
        c.x[first + k] = 150.0 + width * static_cast<double>(k);
        c.y[first + k] = sinks * (shortening - extension) - radius;
        c.radius[first + k] = radius;
    }
    EXPECT_EQ(null_point(all, motion, level(-1401.0), Travel(5000.0)).value(), 0.0);
    EXPECT_EQ(null_point(all, motion, level(-5000.0), Travel(5000.0)).value(), 0.0);
    EXPECT_NEAR(null_point(all, motion, level(-1300.0), Travel(5000.0)).value(), 200.0, 1e-6);
    EXPECT_NEAR(null_point(all, motion, level(0.0), Travel(5000.0)).value(), 2800.0, 1e-6);
    // 0.2 to 1.5 km from the breakaway a line counts by its mean.
    EXPECT_NEAR(
        null_point(state, motion, TargetLine({{0.0, -85.0}, {1700.0, 85.0}}), Travel(5000.0))
            .value(),
        2800.0, 1e-6);
    // Nothing is lost where pores are as open as they were.
    state.discs.add<double>("porosity", "1", 0.5);
    EXPECT_NEAR(
        null_point(state, motion, level(0.0), Travel(5000.0), Decompaction{0.5, 0.0}).value(),
        2800.0, 1e-6);
    // Strata that have lost thickness stood higher: older ones are back at the regional.
    for (double& porosity : state.discs.get<double>("porosity"))
        porosity = 0.4;
    EXPECT_LT(null_point(state, motion, level(0.0), Travel(5000.0), Decompaction{0.5, 0.0}).value(),
              2800.0);
}

TEST(Inversion, ReactivatedShareIsThatOfTheMostStrainedTenth) {
    State state = section(0.0, 10e3, [](double) { return 0.0; }); // 300 discs
    EXPECT_FALSE(reactivated_share(state));
    state.discs.add<double>("total_strain", "1", 0.0);
    state.discs.add<double>("turn_strain", "1", 0.0);
    EXPECT_FALSE(reactivated_share(state)) << "no strain since";
    const auto total = state.discs.get<double>("total_strain"),
               turn = state.discs.get<double>("turn_strain");
    for (std::size_t i = 0; i < total.size(); ++i) {
        turn[i] = i < 30 ? 2.0 : 0.1;
        total[i] = turn[i] + (i < 30 ? 0.9 : 0.1);
    }
    // 30 x 0.9 of 30 x 0.9 + 270 x 0.1
    EXPECT_NEAR(reactivated_share(state).value(), 0.5, 1e-9);
}

} // namespace
} // namespace listric::inversion_test
