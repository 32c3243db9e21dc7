// A column that compacts between walls that rest: nothing extends, so its picture of strain is
// blank.

#include "apps/measures/faults/fault_trace.hpp"
#include "dem/base/ground_level.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/events/compaction.hpp"
#include "dem/events/strain.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::tectonic_strain_test {

using namespace dem;
namespace {

using namespace support;

constexpr double surface_porosity = 0.5, extension_rate = 0.01;

/// A column of loose sediment that is buried by so many metres more than its pores know.
struct Column {
    GenesisRequest request;
    State state;
    Compaction compaction{{}, surface_porosity, extension_rate};
    Strain strain{500.0, extension_rate};

    Column(double radius, double buried_by) : request(packing_request(4e3, 4e3, radius)) {
        request.base.motion.speed = 1.0;
        state = settled(request);
        std::ranges::fill(disc_columns(state).stratum, 1);
        compaction.begin(state);
        const DiscColumns d = disc_columns(state);
        const GroundLevel ground(state);
        const auto porosity = state.discs.get<double>("porosity");
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const double depth = ground.depth({d.x[i], d.y[i]}) - buried_by;
            porosity[i] = surface_porosity *
                          std::exp(-CompactionParameters{}.coefficient * std::max(0.0, depth));
        }
        strain.begin(state);
    }

    /// Compacts to the new depth.
    void compact() {
        for (int k = 0; k < 10; ++k) {
            compaction.apply(state, request.base);
            const double spacing = compaction.schedule().spacing();
            advance(state, request.base, request.physics,
                    static_cast<int>(spacing / state.clock.time_step), {});
        }
    }
};

/// The value that a share of all is below.
double quantile(std::vector<double> values, double share) {
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
}

// Discs shrink evenly, and the column gets lower only: grains slide past each other. In a circle of
// some twenty discs that is a strain of no sense in particular, half as large as the compaction
// (rms 0.03 where the column loses 0.06 of its height), and none in the mean over the column. It
// must not look like a fault: those are traced where 0.05 is reached all along and 0.15 somewhere,
// so half of the discs have less than 0.05 and 95 of 100 less than 0.15. With compaction they have
// more.
TEST(TectonicStrain, OfAColumnThatCompactsWithoutExtensionIsBlank) {
    const measures::FaultTraceOptions fault;
    for (const double radius : {60.0, 100.0}) {
        SCOPED_TRACE(radius);
        Column column(radius, 500.0);
        column.compact();
        const std::vector<double> all = shear_strain(column.state);
        const std::vector<double> tectonic = *tectonic_strain(column.state);
        EXPECT_GT(quantile(all, 0.95), fault.certain_strain);
        EXPECT_LT(quantile(tectonic, 0.95), fault.certain_strain);
        EXPECT_LT(quantile(tectonic, 0.5), fault.least_strain);
        EXPECT_LT(quantile(tectonic, 0.5), 0.8 * quantile(all, 0.5));
    }
}

} // namespace
} // namespace listric::tectonic_strain_test
