// Broken bonds, strain that stays, and relief of strata, where they are known.

#include "apps/measures/faults/broken_rock.hpp"
#include "apps/measures/paper/folds.hpp"
#include "apps/measures/paper/grabens.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace listric::broken_rock_test {

using namespace dem;
using namespace measures;
namespace {

using namespace support;

constexpr double r = 100.0, d = 2.0 * r;

/// A bonded lattice of 60 by 60 discs without bonds between two heights in diameters.
State strip(double from, double to) {
    State state = make_state(hexagonal(60, 60, r));
    bond_all(state, {});
    const DiscColumns discs = disc_columns(state);
    const ContactColumns c = contact_columns(state);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const double y = 0.5 * (discs.y[static_cast<std::size_t>(c.first[k])] +
                                discs.y[static_cast<std::size_t>(c.second[k])]);
        if (y > from * d && y < to * d)
            c.bonded[k] = 0;
        for (const auto row : {c.first[k], c.second[k]}) // pairs touch beyond round-off
            discs.radius[static_cast<std::size_t>(row)] = 1.001 * r;
    }
    return state;
}

TEST(BrokenRock, WidthIsAQuarterOfAStrips) {
    // Half of the pairs around a disc on the strip's side have bonds, so the nearest sound disc is
    // three quarters of a diameter outside; a row is 0.87 diameters, of 52.
    for (const double width : {4.0, 8.0, 16.0}) {
        const BrokenRock found = measure_broken_rock(strip(15.0, 15.0 + width));
        EXPECT_NEAR(found.width, 0.25 * (width + 1.5), 0.5) << width;
        EXPECT_NEAR(found.areal_share, std::max(0.0, width + 1.5 - 8.0) / 52.0, 1.5 * 0.87 / 52.0)
            << width;
    }
}

TEST(BrokenRock, NoneBrokenAndAllBroken) {
    const BrokenRock sound = measure_broken_rock(strip(-2.0, -1.0));
    EXPECT_EQ(sound.width, 0.0);
    EXPECT_EQ(sound.areal_share, 0.0);
    const BrokenRock broken = measure_broken_rock(strip(-1.0, 1e3));
    EXPECT_EQ(broken.width, 64.0);
    EXPECT_EQ(broken.areal_share, 1.0);
}

TEST(StrainCorrelation, OfStrainThatStaysAndThatMoves) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> early(500, 0.0), other(500, 0.0);
    for (std::size_t k = 0; k < 50; ++k) {
        early[k] = 0.1 + 0.001 * static_cast<double>(k);
        other[k + 100] = 0.1 + 0.001 * static_cast<double>(k);
    }
    early.push_back(none);
    other.push_back(1.0);
    EXPECT_NEAR(*strain_correlation(early, early, 0.2), 1.0, 1e-12);
    EXPECT_LT(*strain_correlation(early, other, 0.2), -0.8);
    EXPECT_FALSE(strain_correlation(early, other, 0.03).has_value()); // 15 discs
}

/// A halfgraben and, 10 km beyond, a collapse graben on a flat pre-rift top, with strata that are
/// thicker in the graben by an amount each.
TEST(Relief, FallsByWhatStrataAreThickerInTheGraben) {
    constexpr double radius = 50.0, columns = 300.0;
    constexpr int strata = 6;
    const auto depth = [](double x, int stratum) { // of a stratum's top, m
        const double left = strata - stratum;
        const auto bell = [](double u) { return std::exp(-u * u); };
        return 150.0 * left + 300.0 * left * bell((x - 5e3) / 2e3) +
               250.0 * left * bell((x - 18e3) / 2e3);
    };
    std::vector<Disc> discs;
    std::vector<int> numbers;
    for (int k = 0; k < static_cast<int>(columns); ++k)
        for (int stratum = 0; stratum <= strata; ++stratum)
            for (int row = 0; row < 3; ++row) {
                const double x = (k + 0.5) * 2.0 * radius;
                discs.push_back({x, -depth(x, stratum) - radius - row * 0.4 * radius, radius});
                numbers.push_back(stratum);
            }
    State state = make_state(discs);
    const DiscColumns c = disc_columns(state);
    Profile profile;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        c.stratum[i] = numbers[i];
    for (int k = 0; k < static_cast<int>(columns); ++k) {
        profile.x.push_back((k + 0.5) * 2.0 * radius);
        profile.pre_rift_top.push_back(-depth(profile.x.back(), 0));
    }
    const auto relief = find_relief(state, profile);
    ASSERT_TRUE(relief.has_value());
    // Means over 1 km take 4 % off a bell 2 km wide.
    for (int stratum = 0; stratum <= strata; ++stratum)
        EXPECT_NEAR(relief->inner.at(stratum), 250.0 * (strata - stratum),
                    0.06 * 250.0 * (strata - stratum) + 1.0)
            << stratum;
    EXPECT_NEAR(relief->outer, relief->inner.at(0), 100.0);
}

} // namespace
} // namespace listric::broken_rock_test
