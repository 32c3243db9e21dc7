// Sediment is put in without a shock: each disc lies where it touches and overlaps nothing, and
// then settles under its weight. Expected: fresh sediment overlaps by less than a millimetre, moves
// no faster than in a fall of a radius, breaks few bonds of the rock below; the ledger has its
// mass. Without the remedy, with discs 2 % too large, which is an overlap of a few metres, the
// stiffness of rock throws them about.

#include "dem/events/sedimentation.hpp"
#include "tests/stability/hard_case.hpp"
#include "tests/verification/settled_packing.hpp"

namespace listric::sediment_test {

using namespace dem;
namespace {

using namespace support;

struct Basin {
    GenesisRequest r = packing_request(6e3, 2e3, 100.0);
    State state;
    double inserted_overlap = 0.0, fastest_disc = 0.0; ///< m; m/s
    std::int64_t bonds_broken = 0;

    /// Sediment with radii that are `inflation` times what fits.
    explicit Basin(double inflation) {
        r.bonds = BondStrength{};
        state = settled(r);
        SedimentationParameters p;
        p.level = 1000.0;
        Sedimentation event(p, 1.66, 0.01);
        const std::size_t rock = state.discs.rows();
        state.clock.travel.m = state.clock.extension.m =
            event.schedule().spacing(); // the first stratum
        const double before = total_mass(state);
        EXPECT_TRUE(event.apply(state, r.base));
        EXPECT_GT(state.discs.rows(), rock + 100);
        EXPECT_NEAR(total_mass(state), before + state.ledger.deposited, 1e-12 * before);
        const DiscColumns d = disc_columns(state);
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (d.stratum[i] > 0)
                d.radius[i] *= inflation;
        find_contacts(state, r.base);
        const ContactColumns c = contact_columns(state);
        const std::int64_t bonds = std::ranges::count(c.bonded, std::uint8_t{1});
        for (std::size_t k = 0; k < c.first.size(); ++k) {
            const auto i = static_cast<std::size_t>(c.first[k]);
            const auto j = static_cast<std::size_t>(c.second[k]);
            if (std::max(d.stratum[i], d.stratum[j]) > 0)
                inserted_overlap =
                    std::max(inserted_overlap, d.radius[i] + d.radius[j] -
                                                   std::hypot(d.x[j] - d.x[i], d.y[j] - d.y[i]));
        }
        for (int n = 0; n < 30; ++n) {
            advance_with_restart(state, r.base, r.physics, 100);
            fastest_disc = std::max(fastest_disc, fastest(state));
        }
        bonds_broken = bonds - std::ranges::count(contact_columns(state).bonded, std::uint8_t{1});
    }
};

constexpr double fall = 44.3; // sqrt(2 g r), m/s

TEST(Sediment, SettlesWithoutAShock) {
    const Basin basin(1.0);
    EXPECT_LT(basin.inserted_overlap, 1e-3);
    EXPECT_LT(basin.fastest_disc, fall);
    EXPECT_LT(basin.bonds_broken, 50); // by the load of a kilometre
    EXPECT_EQ(escaped(basin.state, basin.r.base), 0);
}

TEST(Sediment, IsThrownAboutIfItOverlaps) {
    const Basin basin(1.02);
    EXPECT_GT(basin.fastest_disc, 2.0 * fall);
    EXPECT_GT(basin.bonds_broken, 150);
}

} // namespace
} // namespace listric::sediment_test
