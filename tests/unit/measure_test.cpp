// Concentration measures on densities whose answers are known, and depocentres of a drawn profile.
// Piecewise constant densities are exact; the linear one, sampled in n cells, is off by O(1/n^2).

#include "apps/measure.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace listric {
namespace {

constexpr std::size_t n = 1000;

/// Density x on (0, 1) in cells of equal area, in shuffled order.
std::vector<double> linear_density() {
    std::vector<double> density(n);
    for (std::size_t k = 0; k < n; ++k)
        density[k * 7 % n] = (static_cast<double>(k) + 0.5) / n;
    return density;
}

const std::vector<double> equal_areas(n, 3.0);

TEST(Gini, UniformIsZero) {
    EXPECT_NEAR(gini(std::vector<double>(n, 2.0), equal_areas), 0.0, 1e-13);
    EXPECT_NEAR(gini(std::vector<double>{2.0, 2.0}, std::vector<double>{1.0, 5.0}), 0.0, 1e-15);
}

TEST(Gini, AllInOnePlaceIsOneLessThatPlace) {
    std::vector<double> density(n, 0.0);
    density[17] = 4.0;
    EXPECT_NEAR(gini(density, equal_areas), 1.0 - 1.0 / n, 1e-13);
}

TEST(Gini, LinearDensity) {
    // Lorenz curve p^2: 1 - 2 / 3.
    EXPECT_NEAR(gini(linear_density(), equal_areas), 1.0 / 3.0, 1.0 / (n * n));
}

TEST(Gini, AreasWeigh) {
    // Lorenz curve through (0.75, 0.5): 1 - 2 (0.1875 + 0.1875) = 0.25.
    EXPECT_NEAR(gini(std::vector<double>{3.0, 1.0}, std::vector<double>{1.0, 3.0}), 0.25, 1e-15);
    EXPECT_NEAR(gini(std::vector<double>{1.0, 3.0, 1.0, 1.0}, std::vector<double>(4, 1.0)), 0.25,
                1e-15);
}

TEST(Gini, NothingHasNoConcentration) {
    EXPECT_EQ(gini(std::vector<double>{0.0, 0.0}, std::vector<double>{1.0, 1.0}), 0.0);
}

TEST(ShareOfDensest, LinearDensity) {
    for (double share : {0.1, 0.25, 0.5, 1.0})
        EXPECT_NEAR(share_of_densest(linear_density(), equal_areas, share),
                    1.0 - (1.0 - share) * (1.0 - share), 1e-12);
}

TEST(ShareOfDensest, SplitsCells) {
    // The densest cell has a quarter of the area and half of the amount.
    const std::vector<double> density{1.0, 3.0}, area{3.0, 1.0};
    EXPECT_NEAR(share_of_densest(density, area, 0.125), 0.25, 1e-15);
    EXPECT_NEAR(share_of_densest(density, area, 0.25), 0.5, 1e-15);
    EXPECT_NEAR(share_of_densest(density, area, 0.625), 0.75, 1e-15);
}

TEST(ShareOfDensest, UniformIsTheAreaShare) {
    EXPECT_NEAR(share_of_densest(std::vector<double>(n, 2.0), equal_areas, 0.1), 0.1, 1e-13);
    EXPECT_EQ(share_of_densest(std::vector<double>(n, 0.0), equal_areas, 0.1), 0.0);
}

/// Thickness by linear interpolation between (index, thickness) points.
struct Drawn {
    std::vector<double> x, thickness;

    explicit Drawn(std::vector<std::pair<int, double>> points) {
        for (std::size_t p = 0; p + 1 < points.size(); ++p)
            for (int k = points[p].first; k < points[p + 1].first; ++k) {
                const double share = static_cast<double>(k - points[p].first) /
                                     (points[p + 1].first - points[p].first);
                thickness.push_back(points[p].second +
                                    share * (points[p + 1].second - points[p].second));
            }
        thickness.push_back(points.back().second);
        for (std::size_t k = 0; k < thickness.size(); ++k)
            x.push_back(100.0 * static_cast<double>(k));
    }
};

TEST(Depocentre, TwoWithAHighBetween) {
    const Drawn d({{0, 0.0}, {10, 600.0}, {20, 200.0}, {40, 1000.0}, {60, 0.0}});
    const std::vector<Depocentre> found = find_depocentres(d.x, d.thickness, 250.0);
    ASSERT_EQ(found.size(), 2u); // the thickest first
    EXPECT_EQ(found[0].x, 4000.0);
    EXPECT_EQ(found[0].thickness, 1000.0);
    EXPECT_EQ(found[0].prominence, 1000.0);
    EXPECT_EQ(found[1].x, 1000.0);
    EXPECT_EQ(found[1].thickness, 600.0);
    EXPECT_EQ(found[1].prominence, 400.0);
}

TEST(Depocentre, RipplesAreNone) {
    const Drawn d({{0, 0.0}, {10, 600.0}, {20, 360.0}, {40, 1000.0}, {60, 0.0}});
    EXPECT_EQ(find_depocentres(d.x, d.thickness, 250.0).size(), 1u);
    EXPECT_EQ(find_depocentres(d.x, d.thickness, 240.0).size(), 2u);
}

TEST(Depocentre, ProminenceIsToTheHigherPass) {
    // Between two thicker ones: passes of 300 and 100, so 700 has a prominence of 400.
    const Drawn d(
        {{0, 0.0}, {10, 900.0}, {20, 300.0}, {30, 700.0}, {40, 100.0}, {50, 1000.0}, {60, 0.0}});
    const std::vector<Depocentre> found = find_depocentres(d.x, d.thickness, 250.0);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[1].prominence, 800.0); // 900, over the pass of 100
    EXPECT_EQ(found[2].prominence, 400.0);
}

TEST(Depocentre, PlateausAndEndsCountOnce) {
    const Drawn plateau({{0, 0.0}, {10, 500.0}, {20, 500.0}, {30, 0.0}});
    ASSERT_EQ(find_depocentres(plateau.x, plateau.thickness, 250.0).size(), 1u);
    const Drawn end({{0, 800.0}, {30, 0.0}});
    const std::vector<Depocentre> found = find_depocentres(end.x, end.thickness, 250.0);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].x, 0.0);
    const Drawn step({{0, 0.0}, {10, 500.0}, {20, 500.0}, {30, 900.0}, {40, 0.0}});
    EXPECT_EQ(find_depocentres(step.x, step.thickness, 250.0).size(), 1u);
}

TEST(Depocentre, NoSedimentNoDepocentre) {
    const Drawn d({{0, 0.0}, {30, 0.0}});
    EXPECT_TRUE(find_depocentres(d.x, d.thickness, 250.0).empty());
    EXPECT_TRUE(find_depocentres({}, {}, 250.0).empty());
}

TEST(InterveningHigh, BetweenTheFirstDepocentreAndTheMostProminentBeyond) {
    const Drawn d(
        {{0, 0.0}, {10, 900.0}, {20, 350.0}, {30, 700.0}, {40, 300.0}, {50, 1000.0}, {60, 0.0}});
    const auto high = find_intervening_high(d.x, d.thickness, 250.0);
    ASSERT_TRUE(high.has_value());
    EXPECT_EQ(d.x[*high], 4000.0);
    const Drawn one({{0, 0.0}, {10, 900.0}, {60, 0.0}});
    EXPECT_FALSE(find_intervening_high(one.x, one.thickness, 250.0).has_value());
}

TEST(OldSediment, BondedShareOfDeepAndOldPairs) {
    using namespace support;
    constexpr double r = 100.0;
    // Touching discs in a row 1,600 m below the level: basement, three old ones, two young ones.
    State state = make_state(row(6, r));
    const DiscColumns d = disc_columns(state);
    state.clock.extension = 5000.0;
    for (std::size_t i = 0; i < 6; ++i) {
        d.y[i] = -1600.0;
        d.radius[i] = 1.001 * r;
        d.stratum[i] = i == 0 ? 0 : i < 4 ? 1 : 9;
        d.start_extension[i] = i < 4 ? 500.0 : 4000.0;
    }
    find_contacts(state, {});
    EXPECT_EQ(bonded_share_of_old_sediment(state, 0.0, 1500.0, 2000.0), 0.0);
    bond(state, find_pair(state, 1, 2), 1.0f, 1.0f);
    EXPECT_EQ(bonded_share_of_old_sediment(state, 0.0, 1500.0, 2000.0), 0.5);
    EXPECT_EQ(bonded_share_of_old_sediment(state, 0.0, 1500.0, 500.0), 0.25); // the young ones too
    EXPECT_FALSE(bonded_share_of_old_sediment(state, -200.0, 1500.0, 2000.0).has_value());
}

} // namespace
} // namespace listric
