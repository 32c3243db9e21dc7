// Horizons of packings whose strata are known: where a packing is cut into strata along a line, the
// horizon is that line, to the roughness of the discs; between two horizons lies the area of the
// power cells of the stratum.

#include "apps/measures/strata/contour.hpp"
#include "apps/measures/strata/horizons.hpp"
#include "dem/contacts/power_cell.hpp"
#include "dem/numbers/units.hpp"
#include "dem/threads/shared_loop.hpp"
#include "tests/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numeric>

namespace listric::horizons_test {

using namespace dem;
using namespace measures;
namespace {

using namespace support;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double radius = 50.0, diameter = 2.0 * radius;
constexpr double width = 80.0 * diameter;
/// Rows of discs are 1.7 radii apart: a boundary is half of that off the line that made it, and
/// rough by the disturbance of the lattice.
constexpr double roughness = 1.2 * radius;

/// Area on the right of a closed line, m^2.
double area_in(const Polyline& line) {
    double twice = 0.0;
    for (std::size_t k = 0; k < line.size(); ++k)
        twice -= cross(line[k], line[(k + 1) % line.size()]);
    return 0.5 * twice;
}

TEST(Contour, CircleIsClosedAndHasTheLargerValuesOnItsRight) {
    GridValues grid{{-5.0, -5.0}, 0.1, 101, 101, {}};
    for (std::size_t row = 0; row < grid.rows; ++row)
        for (std::size_t column = 0; column < grid.columns; ++column)
            grid.values.push_back(
                static_cast<float>(3.0 - std::hypot(0.1 * static_cast<double>(column) - 5.0,
                                                    0.1 * static_cast<double>(row) - 5.0)));
    const std::vector<Polyline> lines = contours(grid, 0.0);
    ASSERT_THAT(lines, SizeIs(1));
    EXPECT_EQ(lines[0].front(), lines[0].back());
    // Chords of length c leave out pi c^2 / 6, and linear interpolation about as much: 0.1 long.
    EXPECT_NEAR(area_in(lines[0]), pi * 9.0, 0.01);
}

TEST(Contour, SaddleIsJoinedAsItsMiddleSays) {
    // The two high corners of a square, joined or not.
    for (const float low : {-0.5f, -2.0f}) {
        const GridValues grid{{0.0, 0.0}, 1.0, 2, 2, {1.0f, low, low, 1.0f}};
        const std::vector<Polyline> lines = contours(grid, 0.0);
        ASSERT_THAT(lines, SizeIs(2));
        const bool rises =
            (lines[0].back().x - lines[0].front().x) * (lines[0].back().y - lines[0].front().y) >
            0.0;
        EXPECT_EQ(rises, low > -1.0f);
    }
}

TEST(Contour, NothingIsKnownBesideUnknownPlaces) {
    const float unknown = std::nanf("");
    const GridValues grid{{0.0, 0.0}, 1.0, 3, 2, {0.0f, 0.0f, unknown, 2.0f, 2.0f, 2.0f}};
    const std::vector<Polyline> lines = contours(grid, 1.0);
    ASSERT_THAT(lines, SizeIs(1));
    EXPECT_EQ(lines[0], (Polyline{{1.0, 0.5}, {0.0, 0.5}}));
    EXPECT_EQ(grid.at({0.5, 0.25}), 0.5);
    EXPECT_TRUE(std::isnan(grid.at({1.5, 0.5})));
}

/// A packing 80 mean discs wide and 40 rows high whose strata are cut out by a function of place.
class HorizonTest : public testing::Test {
protected:
    HorizonTest() {
        setting.length = width;
        base.surfaces = {{"floor", {line({-width, -radius}, {2.0 * width, -radius})}}};
    }

    void fill(const std::function<int(Point)>& stratum) {
        std::vector<Disc> discs = cloud(80, 40, radius, 1);
        for (Disc& disc : discs)
            disc.x += radius;
        std::erase_if(discs, [&](const Disc& d) { return stratum({d.x, d.y}) < 0; });
        state = make_state(discs);
        state.mean_radius = radius;
        const DiscColumns d = disc_columns(state);
        for (std::size_t i = 0; i < discs.size(); ++i) {
            d.stratum[i] = stratum({discs[i].x, discs[i].y});
            d.start_travel[i] = 500.0 * d.stratum[i];
        }
    }

    std::vector<Horizon> trace(const std::vector<Fault>& faults = {}) const {
        return trace_horizons(setting, base, state, faults, {.pre_rift_layer = 0.0});
    }

    /// Area of the power cells of a stratum, m^2; of discs without a closed cell, what a solid
    /// share as in the closed ones makes of theirs.
    double cells(int stratum) const {
        const ConstDiscColumns d = disc_columns(state);
        std::vector<std::int32_t> rows(d.x.size());
        std::iota(rows.begin(), rows.end(), 0);
        const std::vector<PowerCell> all = power_cells(state, base, rows);
        double closed = 0.0, solid = 0.0, open = 0.0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (d.stratum[i] != stratum)
                continue;
            (all[i].closed ? solid : open) += d.radius[i] * d.radius[i];
            closed += all[i].closed ? all[i].area : 0.0;
        }
        return closed * (1.0 + open / solid);
    }

    /// Area between two tops that both go from wall to wall, m^2.
    static double between(const Horizon& low, const Horizon& high) {
        EXPECT_THAT(low.top, SizeIs(1));
        EXPECT_THAT(high.top, SizeIs(1));
        Polyline around = high.top[0];
        around.insert(around.end(), low.top[0].rbegin(), low.top[0].rend());
        return area_in(around);
    }

    Setting setting;
    RigidBase base;
    State state;
};

// Level strata of 5 discs and of 1: horizons run through the packing a stratum's thickness apart.
TEST_F(HorizonTest, LevelStrata) {
    const std::vector<double> levels{1000.0, 1500.0, 1600.0, 2100.0, 1e9};
    fill([&](Point p) {
        return static_cast<int>(std::ranges::upper_bound(levels, p.y) - levels.begin());
    });
    const std::vector<Horizon> horizons = trace();
    ASSERT_THAT(horizons, SizeIs(5));
    for (std::size_t k = 0; k < horizons.size(); ++k) {
        EXPECT_EQ(horizons[k].stratum, static_cast<int>(k));
        ASSERT_THAT(horizons[k].pieces, SizeIs(1));
        const Polyline& piece = horizons[k].pieces[0];
        EXPECT_NEAR(piece.front().x, 0.0, 1e-9);
        EXPECT_NEAR(piece.back().x, width, 1e-9);
        EXPECT_EQ(piece, horizons[k].top[0]);
    }
    EXPECT_FALSE(horizons[0].deposited_at);
    EXPECT_NEAR(*horizons[2].deposited_at, 1e5, 1e-6); // 1000 m at 10 mm/a
    for (std::size_t k = 1; k < horizons.size(); ++k)
        EXPECT_NEAR(between(horizons[k - 1], horizons[k]) / cells(static_cast<int>(k)), 1.0, 0.02);
    for (std::size_t k = 0; k < 4; ++k)
        for (const Point p : horizons[k].pieces[0])
            EXPECT_NEAR(p.y, levels[k], roughness);
    for (const int threads : {2, 3, 8}) { // which trace as many at once
        const Team team(threads);
        const std::vector<Horizon> shared = trace();
        ASSERT_THAT(shared, SizeIs(5));
        for (std::size_t k = 0; k < shared.size(); ++k) {
            EXPECT_EQ(shared[k].stratum, horizons[k].stratum);
            EXPECT_EQ(shared[k].top, horizons[k].top);
            EXPECT_EQ(shared[k].pieces, horizons[k].pieces);
        }
    }
}

// A stratum of scattered discs, half a disc thick, loses nothing: that is what a fit to the tops of
// its discs would do.
TEST_F(HorizonTest, ThinStratumKeepsItsArea) {
    Random random(2);
    std::map<std::pair<double, double>, bool> taken;
    fill([&](Point p) {
        if (p.y < 1500.0 || p.y > 1600.0)
            return p.y < 1500.0 ? 0 : 2;
        const auto [place, is_new] = taken.try_emplace({p.x, p.y}, false);
        if (is_new)
            place->second = random.between(0.0, 1.0) < 0.5;
        return place->second ? 1 : 2;
    });
    const std::vector<Horizon> horizons = trace();
    ASSERT_THAT(horizons, SizeIs(3));
    EXPECT_NEAR(between(horizons[0], horizons[1]) / cells(1), 1.0, 0.03);
}

// A wedge that ends in the middle is drawn to within some discs of its tip: there it is thinner
// than a disc. Its `top` goes on along the stratum below.
TEST_F(HorizonTest, WedgeEndsWhereItsStratumDoes) {
    fill([](Point p) {
        const double thickness = 600.0 * (1.0 - p.x / (0.5 * width));
        return p.y < 1500.0 ? 0 : p.y < 1500.0 + thickness ? 1 : 2;
    });
    const std::vector<Horizon> horizons = trace();
    ASSERT_THAT(horizons, SizeIs(3));
    ASSERT_THAT(horizons[1].pieces, SizeIs(1));
    EXPECT_NEAR(horizons[1].pieces[0].front().x, 0.0, 1e-9);
    // The wedge falls by 15 m per disc: it is a disc thick 6.7 discs from the tip.
    EXPECT_NEAR(horizons[1].pieces[0].back().x, 0.5 * width, 7.0 * diameter);
    EXPECT_NEAR(between(horizons[0], horizons[1]) / cells(1), 1.0, 0.02);
    EXPECT_NEAR(horizons[1].top[0].back().x, width, 1e-9);
}

// Strata tilted by 6 degrees and cut by a level free surface: all areas are kept, and a top goes on
// along the surface.
TEST_F(HorizonTest, ErodedStrata) {
    fill([](Point p) {
        const double above = p.y - 500.0 - 0.1 * p.x;
        return p.y > 2280.0 ? -1 : above < 0.0 ? 0 : 1 + static_cast<int>(above / 600.0);
    });
    const std::vector<Horizon> horizons = trace();
    ASSERT_THAT(horizons, SizeIs(4));
    double traced = 0.0, expected = 0.0;
    for (std::size_t k = 1; k < horizons.size(); ++k) {
        const double area = between(horizons[k - 1], horizons[k]);
        EXPECT_NEAR(area / cells(static_cast<int>(k)), 1.0, 0.05) << k;
        traced += area;
        expected += cells(static_cast<int>(k));
    }
    EXPECT_NEAR(traced / expected, 1.0, 0.01);
    for (const Point p : horizons[2].pieces.back())
        EXPECT_LT(p.y, 2280.0 + radius);
    EXPECT_NEAR(horizons[2].pieces.back().back().y, 2280.0, diameter);
}

// A normal fault of 60 degrees that throws 350 m: every horizon has two pieces, which end on it.
TEST_F(HorizonTest, FaultCutsAndTheOffsetIsItsThrow) {
    constexpr double offset = 350.0;
    const Point top{3000.0, 3600.0}, bottom{top.x + 3600.0 / std::sqrt(3.0), 0.0};
    Fault fault;
    for (int k = 0; k <= 36; ++k)
        fault.trace.points.push_back(top + (k / 36.0) * (bottom - top));
    const auto beyond = [&](Point p) { return cross(bottom - top, p - top) > 0.0; };
    fill([&](Point p) {
        const double y = beyond(p) ? p.y + offset : p.y;
        return y < 1000.0 ? 0 : y < 1500.0 ? 1 : y < 2000.0 ? 2 : 3;
    });
    const std::vector<Horizon> whole = trace();
    const std::vector<Horizon> horizons = trace({fault});
    ASSERT_THAT(horizons, SizeIs(4));
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(horizons[k].top, whole[k].top);
        EXPECT_THAT(whole[k].pieces, SizeIs(1));
        ASSERT_THAT(horizons[k].pieces, SizeIs(2));
        const Point left = horizons[k].pieces[0].back(), right = horizons[k].pieces[1].front();
        // Ends lie on the trace, up to round-off, and a straight piece keeps its direction to a
        // few degrees over the 1.5 diameters that are bridged: a third of a diameter.
        for (const Point end : {left, right})
            EXPECT_NEAR(place_on(fault.trace.points, end).distance, 0.0, 1e-6);
        EXPECT_NEAR(left.y - right.y, offset, 0.7 * diameter);
        EXPECT_LT(left.x, right.x);
    }
}

TEST_F(HorizonTest, FaultThatIsNotCrossedCutsNothing) {
    fill([](Point p) { return p.y < 1500.0 ? 0 : 1; });
    Fault fault;
    fault.trace.points = {{3000.0, 1300.0}, {3100.0, 1200.0}, {3200.0, 1100.0}, {3300.0, 800.0}};
    const std::vector<Horizon> horizons = trace({fault});
    EXPECT_THAT(horizons[0].pieces, SizeIs(1));
}

// Layers of pre-rift rock are by depth at the start, wherever they are now.
TEST_F(HorizonTest, PreRiftLayers) {
    fill([](Point) { return 0; });
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        d.start_y[i] = d.y[i] - 3400.0;
    const std::vector<Horizon> horizons =
        trace_horizons(setting, base, state, {}, {.pre_rift_layer = 1000.0});
    ASSERT_THAT(horizons, SizeIs(4));
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(horizons[k].stratum, static_cast<int>(k) - 3);
        ASSERT_THAT(horizons[k].pieces, SizeIs(1));
        for (const Point p : horizons[k].pieces[0])
            EXPECT_NEAR(p.y, 400.0 + 1000.0 * static_cast<double>(k), roughness);
    }
}

TEST_F(HorizonTest, FreeSurfaceIsTheTopOfAll) {
    fill([](Point p) { return p.y > 2400.0 ? -1 : p.y < 1500.0 ? 0 : 1; });
    EXPECT_EQ(free_surface(setting, base, state), trace()[1].top);
}

} // namespace
} // namespace listric::horizons_test
