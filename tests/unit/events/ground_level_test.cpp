// The surface over columns one mean diameter wide, averaged over five: exact for level ground and,
// in the middle, for a slope of discs that lie in the middle of their columns.

#include "dem/base/ground_level.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::ground_level_test {

using namespace dem;
namespace {

using namespace support;

TEST(GroundLevel, OfLevelGroundAndOfASlope) {
    std::vector<Disc> level = row(40, 50.0), slope = level;
    for (Disc& disc : slope)
        disc.y = 0.3 * disc.x;
    level.push_back({500.0, -200.0, 50.0}); // below the surface: of no matter
    const GroundLevel flat(make_state(level)), steep(make_state(slope));
    for (const double x : {-100.0, 0.0, 777.0, 3900.0, 5000.0})
        EXPECT_NEAR(flat.height(x), 50.0, 1e-9) << x;
    EXPECT_NEAR(flat.depth({500.0, -200.0}), 250.0, 1e-9);
    for (const double x : {1010.0, 2000.0, 2345.0}) // a column begins at its disc
        EXPECT_NEAR(steep.height(x + 50.0), 50.0 + 0.3 * x, 1e-9) << x;
}

TEST(GroundLevel, MayLeaveOutWhatWasLaidDownLately) {
    std::vector<Disc> discs = row(40, 50.0);
    for (const Disc& disc : row(42, 50.0))
        discs.push_back({disc.x - 100.0, 100.0, 50.0});
    State state = make_state(discs);
    const DiscColumns d = disc_columns(state);
    std::ranges::fill(d.stratum.subspan(40), 1);
    std::ranges::fill(d.start_travel.subspan(40), 200.0);
    state.clock.travel.m = state.clock.extension.m = 250.0;
    EXPECT_NEAR(GroundLevel(state).height(777.0), 150.0, 1e-9);
    EXPECT_NEAR(GroundLevel(state, 50.0).height(777.0), 150.0, 1e-9);
    EXPECT_NEAR(GroundLevel(state, 51.0).height(777.0), 50.0, 1e-9);
}

TEST(GroundLevel, GoesOnWhereThereIsNoDisc) {
    const GroundLevel ground(make_state({{0.0, 0.0, 50.0}, {3000.0, 100.0, 50.0}}));
    EXPECT_NEAR(ground.height(1500.0), 50.0, 1e-9);
    EXPECT_NEAR(ground.height(3000.0), 150.0, 1e-9);
}

} // namespace
} // namespace listric::ground_level_test
