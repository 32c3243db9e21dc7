// Radii from 1 to 10. The smallest discs weigh a hundredth of the largest, and a large one touches
// up to thirty small ones, where the time step allows for six contacts.
// The remedy: discs lighter than three quarters of the mean move as if they had that mass. Without
// it, that time step is ten times too long for the smallest.
// Expected: the packing settles, the floor carries the weight, no disc escapes, and without losses
// a disturbed packing does not grow hotter.

#include "tests/stability/hard_case.hpp"
#include "tests/verification/settled_packing.hpp"

namespace listric::size_ratio_test {

using namespace dem;
namespace {

using namespace support;

GenesisRequest request() {
    GenesisRequest r = packing_request(4e3, 4e3, 100.0);
    r.hanging_wall.radius_ratio = 10.0;
    r.bonds = BondStrength{1e30, 0.0, 1e30, 0.0, StrengthReading::force};
    return r;
}

TEST(SizeRatio, TenSettlesAndStaysQuiet) {
    const GenesisRequest r = request();
    State state = settled(r);
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    const auto [smallest, largest] = std::ranges::minmax(d.radius);
    EXPECT_GT(largest / smallest, 8.0);
    EXPECT_EQ(escaped(state, r.base), 0);
    advance_with_restart(state, r.base, r.physics, 4000);
    EXPECT_LT(fastest(state), 0.05);
    double lift = 0.0;
    for (const SurfaceLoad& load : surface_loads(state, r.base))
        lift += load.force.y;
    EXPECT_NEAR(lift, 9.81 * total_mass(state), 0.02 * 9.81 * total_mass(state));

    const DiscColumns moved = disc_columns(state);
    Random random(8);
    for (std::size_t i = 0; i < moved.x.size(); ++i)
        moved.vx[i] += 1e-3 * random.between(-1.0, 1.0);
    advance(state, r.base, {0.0, 9.81}, 10000);
    EXPECT_LT(fastest(state), 0.1);
}

TEST(SizeRatio, TenIsLostWithoutTheFloorOfTheMass) {
    const GenesisRequest r = request();
    State state = settled(r);
    state.inertial_mass_floor = 0.0;
    const DiscColumns d = disc_columns(state);
    Random random(8);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        d.vx[i] += 1e-3 * random.between(-1.0, 1.0);
    EXPECT_THROW(advance(state, r.base, r.physics, 10000), NumericalFailure);
}

} // namespace
} // namespace listric::size_ratio_test
