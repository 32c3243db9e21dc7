#include "apps/measures/faults/wall_wedge.hpp"
#include "dem/columns.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace listric::wall_wedge_test {
namespace {

using namespace dem;
using namespace measures;
using support::Disc;
using support::make_state;

constexpr double r = 50.0, thickness = 4e3, length = 20e3;

Setting resting() {
    Setting setting;
    setting.length = length;
    setting.thickness = thickness;
    setting.has_detachment = true;
    setting.motion.runs_from = runs_nowhere;
    return setting;
}

/// Discs in rows and columns below a ground that rises to the wall by `slope`.
State block(double slope) {
    std::vector<Disc> discs;
    for (double x = r; x < length; x += 2.0 * r)
        for (double y = r - thickness; y < slope * std::max(0.0, x - 10e3); y += 2.0 * r)
            discs.push_back({x, y, r});
    return make_state(discs);
}

/// Moves what lies above a plane from the wall's foot along with the wall.
void move(State& state, double dip, double extension) {
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if ((d.y[i] + thickness) > std::tan(dip) * (length - d.x[i]))
            d.x[i] += extension;
    state.clock.travel.m = std::abs(extension);
    state.clock.extension.m = extension;
}

Profile profile_of(const State& state, const Setting& setting) {
    RigidBase base;
    base.surfaces = {{"detachment", {line({0.0, -thickness}, {1e5, -thickness})}, 0.0}};
    return measure_profile(setting, state, base);
}

TEST(WallWedge, FindsTheBorderOfWhatTheWallMoved) {
    for (const double dip : {30.0, 45.0, 60.0})
        for (const double extension : {400.0, -400.0}) {
            State state = block(0.0);
            move(state, dip * pi / 180.0, extension);
            const Setting setting = resting();
            const WallWedge wedge = measure_wall_wedge(setting, state, profile_of(state, setting));
            ASSERT_TRUE(wedge.border_dip) << dip;
            EXPECT_NEAR(*wedge.border_dip, dip, 1.0) << extension; // columns are 100 m wide
        }
}

TEST(WallWedge, MeasuresTheSlopeOfGroundThatIsPushed) {
    State state = block(0.2);
    move(state, 0.5, -100.0);
    const Setting setting = resting();
    const WallWedge wedge = measure_wall_wedge(setting, state, profile_of(state, setting));
    ASSERT_TRUE(wedge.slope);
    EXPECT_NEAR(*wedge.slope, std::atan(0.2) * 180.0 / pi, 0.5);
    move(state, 0.5, 100.0); // leaves it
    EXPECT_FALSE(measure_wall_wedge(setting, state, profile_of(state, setting)).slope);
}

TEST(WallWedge, IsOfABaseAtRest) {
    State state = block(0.2);
    move(state, 0.5, -100.0);
    Setting setting = resting();
    setting.motion.runs_from = 0.0;
    const WallWedge wedge = measure_wall_wedge(setting, state, profile_of(state, setting));
    EXPECT_FALSE(wedge.border_dip || wedge.slope);
    setting.motion.stages = {{.runs_from = runs_nowhere}};
    EXPECT_TRUE(measure_wall_wedge(setting, state, profile_of(state, setting)).border_dip);
}

} // namespace
} // namespace listric::wall_wedge_test
