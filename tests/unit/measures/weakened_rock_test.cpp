// A weakened disc is of a fault near a traced line or in a band as long as a trace, and else not.

#include "apps/measures/faults/rock_behaviour.hpp"
#include "apps/measures/faults/weakened_rock.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::measures::weakened_rock_test {

using namespace dem;
namespace {

using namespace support;

constexpr double radius = 50.0;

/// A row of touching weakened discs along the x axis, and sediment apart from it.
State row_of(int count) {
    std::vector<Disc> discs;
    for (int k = 0; k < count; ++k)
        discs.push_back({2.0 * radius * k, 0.0, radius});
    discs.push_back({0.0, 5000.0, radius});
    State state = make_state(discs);
    const DiscColumns d = disc_columns(state);
    std::fill_n(d.material.begin(), count, weak);
    d.material[d.x.size() - 1] = sediment;
    d.stratum[d.x.size() - 1] = 1;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        d.radius[i] *= 1.0 + 1e-9; // they touch
    find_contacts(state, {});
    return state;
}

/// A fault whose trace is this line.
Fault fault(Polyline points) {
    Fault f;
    f.trace.points = std::move(points);
    return f;
}

std::ptrdiff_t of_faults(const State& state, const std::vector<Fault>& faults) {
    return std::ranges::count(weakened_by_faults(state, faults), true);
}

TEST(WeakenedRock, OfABandAsLongAsATraceIsOfAFaultThoughNothingIsTraced) {
    EXPECT_EQ(of_faults(row_of(12), {}), 12);
    EXPECT_EQ(of_faults(row_of(11), {}), 0);
    EXPECT_EQ(*weak_off_fault(row_of(12), {}), 0.0);
    EXPECT_EQ(*weak_off_fault(row_of(11), {}), 1.0);
}

TEST(WeakenedRock, WithinFiveDiametersOfATraceIsOfIt) {
    const State state = row_of(6);
    EXPECT_EQ(of_faults(state, {fault({{-100.0, 490.0}, {900.0, 490.0}})}), 6);
    EXPECT_EQ(of_faults(state, {fault({{-100.0, 510.0}, {900.0, 510.0}})}), 0);
    // Beyond the end of a trace, too: the discs at 0 to 500 m are 450 m and more from its end.
    EXPECT_EQ(of_faults(state, {fault({{950.0, 0.0}, {2000.0, 0.0}})}), 1);
    EXPECT_NEAR(*weak_off_fault(state, std::vector{fault({{950.0, 0.0}, {2000.0, 0.0}})}),
                5.0 / 6.0, 1e-12);
}

TEST(WeakenedRock, BandsThatDoNotTouchAreTwo) {
    State state = row_of(16);
    disc_columns(state).material[8] = basement;
    EXPECT_EQ(of_faults(state, {}), 0);
}

TEST(WeakenedRock, HasNoShareWhereNothingIsWeakened) {
    State state = row_of(3);
    std::ranges::fill(disc_columns(state).material, basement);
    EXPECT_FALSE(weak_off_fault(state, {}));
}

TEST(WeakenedRock, IsAClassOfItsOwnInPictures) {
    const State state = row_of(6);
    EXPECT_EQ(rock_behaviour(state, {}).front(), RockBehaviour::weak_off_fault);
    EXPECT_EQ(rock_behaviour(state, std::vector{fault({{-100.0, 0.0}, {900.0, 0.0}})}).front(),
              RockBehaviour::weakened);
    EXPECT_EQ(rock_behaviour(state, {}).back(), RockBehaviour::unconsolidated);
}

} // namespace
} // namespace listric::measures::weakened_rock_test
