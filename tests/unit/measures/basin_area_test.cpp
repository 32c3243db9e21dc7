// The area of a basin is that between the pre-rift top of the start and of now.

#include "apps/measures/basin/profile.hpp"
#include "dem/state.hpp"

#include <gtest/gtest.h>

namespace listric::measures::basin_area_test {

using namespace dem;
namespace {

/// A row of discs side by side, 10 m in radius, whose tops were at a height, m, when they started.
State row_of_discs(std::size_t count, double top) {
    State state = empty_state();
    state.mean_radius = 10.0;
    add_discs(state, count);
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < count; ++i) {
        d.radius[i] = 10.0;
        d.start_x[i] = 20.0 * static_cast<double>(i) + 10.0;
        d.start_y[i] = top - 10.0;
        d.x[i] = d.start_x[i] + 5e3; // wherever they are now
        d.y[i] = -5e3;
    }
    return state;
}

TEST(BasinArea, IsNotThatOfAPackingThatIsTooHighOrTooLow) {
    Setting setting;
    setting.length = 1000.0;
    EXPECT_DOUBLE_EQ(area_above_start(setting, row_of_discs(50, 60.0)), -60.0 * 1000.0);
    EXPECT_DOUBLE_EQ(area_above_start(setting, row_of_discs(50, -30.0)), 30.0 * 1000.0);
}

TEST(BasinArea, OfTheStartIsThatOfPreRiftRockThatIsThere) {
    Setting setting;
    setting.length = 1000.0;
    State state = row_of_discs(50, 60.0);
    const DiscColumns d = disc_columns(state);
    d.stratum[3] = 1; // came later
    d.start_y[7] = 90.0;
    EXPECT_DOUBLE_EQ(area_above_start(setting, state), -60.0 * 48.0 * 20.0 - 100.0 * 20.0);
}

} // namespace
} // namespace listric::measures::basin_area_test
