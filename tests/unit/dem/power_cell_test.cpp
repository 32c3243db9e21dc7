// Power cells: a lattice's cell has the lattice's area per disc, the boundary of two discs is
// their radical axis, and cells fill a box. Cells are cut by a few lines each, so areas are good to
// about 1e-14 of their size; 1e-12 leaves a margin.

#include "dem/contacts/power_cell.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace listric::power_cell_test {

using namespace dem;
namespace {

using namespace support;

std::vector<std::int32_t> all_rows(const State& state) {
    std::vector<std::int32_t> rows(state.discs.rows());
    std::iota(rows.begin(), rows.end(), 0);
    return rows;
}

TEST(PowerCell, HexagonalLattice) {
    const State state = make_state(hexagonal(11, 11, 90.0));
    const PowerCell cell = power_cells(state, {}, std::vector<std::int32_t>{60})[0];
    EXPECT_TRUE(cell.closed);
    const double expected = 2.0 * std::sqrt(3.0) * 90.0 * 90.0;
    EXPECT_NEAR(cell.area, expected, 1e-12 * expected);
}

TEST(PowerCell, SquareLattice) {
    std::vector<Disc> discs;
    for (int k = 0; k < 121; ++k)
        discs.push_back({180.0 * (k % 11), 180.0 * static_cast<double>(k / 11), 90.0});
    const PowerCell cell = power_cells(make_state(discs), {}, std::vector<std::int32_t>{60})[0];
    EXPECT_TRUE(cell.closed);
    EXPECT_NEAR(cell.area, 180.0 * 180.0, 1e-12 * 180.0 * 180.0);
}

TEST(PowerCell, UnequalDiscsMeetAtTheirRadicalAxis) {
    // Distance of the axis from the first disc: (d^2 + r_1^2 - r_2^2) / (2 d) = 1 for these.
    const State state = make_state({{1.0, 1.0, 1.0}, {2.6, 1.0, 0.6}});
    const std::vector<PowerCell> cells = power_cells(state, box(3.2, 2.0), all_rows(state));
    // The box has no lid: its top is the starting square's, 2.5 mean radii = 2 above the centres.
    EXPECT_FALSE(cells[0].closed);
    EXPECT_NEAR(cells[0].area, 2.0 * 3.0, 1e-12);
    EXPECT_NEAR(cells[1].area, 1.2 * 3.0, 1e-12);
}

TEST(PowerCell, RandomPackingFillsItsBox) {
    const double width = 21.0 * 90.0, height = (19.0 * std::sqrt(3.0) + 2.0) * 90.0;
    for (std::uint64_t seed : {1, 2, 3}) {
        std::vector<Disc> discs = cloud(10, 20, 90.0, seed);
        for (Disc& disc : discs) {
            disc.x += 90.0;
            disc.y += 90.0;
        }
        const State state = make_state(discs);
        RigidBase base = box(width, height);
        base.surfaces.push_back({"lid", {line({width, height}, {0.0, height})}});
        double sum = 0.0;
        for (const PowerCell& cell : power_cells(state, base, all_rows(state))) {
            EXPECT_TRUE(cell.closed);
            EXPECT_GT(cell.area, 0.0);
            sum += cell.area;
        }
        EXPECT_NEAR(sum, width * height, 1e-12 * width * height);
    }
}

TEST(PowerCell, SurfaceOfThePackingIsOpen) {
    const State state = make_state(hexagonal(5, 5, 90.0));
    const std::vector<PowerCell> cells = power_cells(state, {}, all_rows(state));
    EXPECT_TRUE(cells[12].closed);
    EXPECT_FALSE(cells[0].closed);
    EXPECT_FALSE(cells[22].closed);
}

TEST(PowerCell, WeakenedDiscsCountWithTheirRock) {
    State state = make_state(hexagonal(11, 11, 90.0));
    const double expected = 2.0 * std::sqrt(3.0) * 90.0 * 90.0;
    state.discs.add<double>("rock_radius", "m", 0.0)[60] = 90.0;
    disc_columns(state).radius[60] *= 1.3;
    EXPECT_NEAR(power_cells(state, {}, std::vector<std::int32_t>{60})[0].area, expected,
                1e-12 * expected);
    EXPECT_EQ(rock_radii(state)[60], 90.0);
    EXPECT_EQ(rock_radii(state)[59], 90.0);
}

TEST(PowerCell, FacetsBoundTheSameCells) {
    std::vector<Disc> discs = cloud(10, 14, 90.0, 4);
    for (Disc& disc : discs) {
        disc.x += 90.0;
        disc.y += 90.0;
    }
    const State state = make_state(discs);
    const RigidBase base = box(21.0 * 90.0, 1e4);
    const std::vector<std::int32_t> rows = all_rows(state);
    const std::vector<double> none(rows.size(), std::numeric_limits<double>::infinity());
    const std::vector<PowerCell> cells = power_cells(state, base, rows);
    const FacetedCells faceted = faceted_cells(state, base, rows, none);
    const ConstDiscColumns d = disc_columns(state);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        EXPECT_NEAR(faceted.cells[k].area, cells[k].area, 1e-12 * cells[k].area);
        EXPECT_EQ(faceted.cells[k].closed, cells[k].closed);
        double twice = 0.0; // the area once more, in triangles about the disc's centre
        for (const PowerFacet& f : faceted.of(k)) {
            const bool is_disc = f.neighbour >= 0;
            const auto j = static_cast<std::size_t>(is_disc ? f.neighbour : 0);
            if (is_disc) {
                const Point n{(d.x[j] - d.x[k]) / f.distance, (d.y[j] - d.y[k]) / f.distance};
                twice += f.length * (f.arm.x * n.x + f.arm.y * n.y);
            } else {
                twice += f.length * f.distance;
            }
        }
        EXPECT_NEAR(0.5 * twice, cells[k].area, 1e-12 * cells[k].area);
    }
}

TEST(PowerCell, TwoCellsHaveOneFacet) {
    const State state = make_state(cloud(10, 10, 90.0, 6));
    const std::vector<std::int32_t> rows = all_rows(state);
    const FacetedCells cells = faceted_cells(
        state, {}, rows, std::vector<double>(rows.size(), std::numeric_limits<double>::infinity()));
    for (std::size_t k = 0; k < rows.size(); ++k)
        for (const PowerFacet& f : cells.of(k)) {
            // Open cells end where their squares do, which differ.
            if (f.neighbour < 0 || !cells.cells[k].closed ||
                !cells.cells[static_cast<std::size_t>(f.neighbour)].closed)
                continue;
            const auto back = cells.of(static_cast<std::size_t>(f.neighbour));
            const auto other = std::ranges::find(back, rows[k], &PowerFacet::neighbour);
            ASSERT_NE(other, back.end());
            EXPECT_NEAR(other->length, f.length, 1e-10 * 90.0);
        }
}

TEST(PowerCell, ALidEndsIt) {
    const State state = make_state({{0.0, 0.0, 90.0}});
    const std::vector<std::int32_t> rows{0};
    const FacetedCells cells = faceted_cells(state, {}, rows, std::vector<double>{90.0});
    const double half = 2.5 * 90.0;
    EXPECT_NEAR(cells.cells[0].area, 2.0 * half * (half + 90.0), 1e-9);
    const auto facets = cells.of(0);
    const auto lid = std::ranges::find(facets, facet_on_lid, &PowerFacet::neighbour);
    ASSERT_NE(lid, facets.end());
    EXPECT_EQ(lid->length, 2.0 * half);
    EXPECT_EQ(lid->distance, 90.0);
}

} // namespace
} // namespace listric::power_cell_test
