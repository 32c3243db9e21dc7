// A cemented column at rest under a burial by 100 m: bonds break by what the column does, not by
// the event. Bonds hold 20 kPa, some hundredths of a millimetre of gap; discs of 100 m overlap by
// up to 0.3 m at 5 km and shrink by 0.4 m.

#include "dem/base/ground_level.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/events/compaction.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::compaction_test {

using namespace dem;
namespace {

using namespace support;

constexpr double surface_porosity = 0.5, extension_rate = 0.01, buried_by = 100.0;

struct Column {
    GenesisRequest request = packing_request(3e3, 5e3, 100.0);
    State state;
    Compaction compaction{{}, surface_porosity, extension_rate};
    std::int64_t bonds;

    Column() {
        request.bonds = BondStrength{};
        request.base.motion.speed = 1.0;
        state = settled(request);
        std::ranges::fill(disc_columns(state).stratum, 1);
        compaction.begin(state);
        go(10000);
        bonds = unbroken();
        // Porosity is that of the depth before the burial.
        const DiscColumns d = disc_columns(state);
        const GroundLevel ground(state);
        const auto porosity = state.discs.get<double>("porosity");
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const double depth = ground.depth({d.x[i], d.y[i]}) - buried_by;
            porosity[i] = surface_porosity *
                          std::exp(-CompactionParameters{}.coefficient * std::max(0.0, depth));
        }
    }

    void go(int cycles) { advance(state, request.base, request.physics, cycles, {}); }

    int cycles_to_the_next_application() const {
        return static_cast<int>(compaction.schedule().spacing() / state.clock.time_step);
    }

    std::span<double> radius_rates() { return state.discs.get<double>("radius_rate"); }

    std::int64_t unbroken() const {
        return std::ranges::count(contact_columns(state).bonded, std::uint8_t{1});
    }
};

TEST(CompactionOfACementedColumn, BreaksNoBondByTheEventItself) {
    Column column;
    ASSERT_GT(column.bonds, 600);
    column.compaction.apply(column.state, column.request.base);
    EXPECT_LT(std::ranges::min(column.radius_rates()), -0.01);
    column.go(1);
    EXPECT_EQ(column.unbroken(), column.bonds);
    // By the next application it is the column that cracks: it can sink after the discs that
    // shrink, but walls do not follow.
    column.go(column.cycles_to_the_next_application());
    EXPECT_GT(column.unbroken(), 3 * column.bonds / 4);
}

TEST(CompactionOfACementedColumn, BreaksMostOfThemAtOnce) {
    Column column;
    column.compaction.apply(column.state, column.request.base);
    const DiscColumns d = disc_columns(column.state);
    const auto rates = column.radius_rates();
    for (std::size_t i = 0; i < rates.size(); ++i) {
        d.radius[i] += rates[i] * column.compaction.schedule().spacing();
        rates[i] = 0.0;
    }
    column.go(1);
    EXPECT_LT(column.unbroken(), column.bonds / 2);
}

} // namespace
} // namespace listric::compaction_test
