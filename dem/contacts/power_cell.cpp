#include "dem/contacts/power_cell.hpp"

#include "dem/base/place.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/contacts/power_polygon.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace listric::dem {

namespace {

/// Cuts off what is beyond surfaces of the base within `half` of the centre.
void clip(PowerPolygon& polygon, const RigidBase& base, const BasePlace& place, Point centre,
          double half) {
    for (const Surface& s : base.surfaces)
        if (const auto foot = nearest(s, place, centre); foot && foot->distance < half)
            polygon.clip({-foot->normal.x, -foot->normal.y}, foot->distance, facet_on_base);
}

double reach_of(const State& state) { return 5.0 * state.mean_radius; }

} // namespace

std::vector<double> rock_radii(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<double> radius(d.radius.begin(), d.radius.end());
    if (state.discs.has(columns::rock_radius)) {
        const auto rock = state.discs.get(columns::rock_radius);
        for (std::size_t i = 0; i < radius.size(); ++i)
            if (rock[i] > 0.0)
                radius[i] = rock[i];
    }
    return radius;
}

std::vector<PowerCell> power_cells(const State& state, const RigidBase& base,
                                   std::span<const std::int32_t> rows) {
    const ConstDiscColumns d = disc_columns(state);
    const std::vector<double> radius = rock_radii(state);
    const double reach = reach_of(state);
    const Cells cells(d.x, d.y, reach);
    std::vector<PowerCell> result(rows.size());
    const BasePlace place = base_place(state);
    in_pieces(rows.size(), 64, [&](std::size_t k, std::size_t end) {
        PowerPolygon polygon;
        for (; k < end; ++k) {
            const auto i = static_cast<std::size_t>(rows[k]);
            const double half = 0.5 * reach;
            polygon.begin(half);
            clip(polygon, base, place, {d.x[i], d.y[i]}, half);
            cells.for_each_near(d.x[i], d.y[i], [&](std::int32_t row) {
                const auto j = static_cast<std::size_t>(row);
                const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
                const double square = dx * dx + dy * dy;
                if (j == i || square > reach * reach || square == 0.0)
                    return;
                polygon.clip({dx, dy},
                             0.5 * (square + radius[i] * radius[i] - radius[j] * radius[j]), row);
            });
            result[k] = polygon.cell();
        }
    });
    return result;
}

void FacetedPiece::add(const PowerPolygon& polygon, std::size_t i, std::span<const double> x,
                       std::span<const double> y) {
    const std::size_t before = facets.size();
    polygon.for_each_edge([&](const auto& a, const auto& b) {
        const Point edge = b.p - a.p;
        const double length = norm(edge);
        if (length == 0.0)
            return;
        const Point arm{0.5 * (a.p.x + b.p.x), 0.5 * (a.p.y + b.p.y)};
        const auto j = static_cast<std::size_t>(a.beyond);
        const double distance = a.beyond >= 0 ? hypotenuse(x[j] - x[i], y[j] - y[i])
                                              : (arm.x * edge.y - arm.y * edge.x) / length;
        facets.push_back({a.beyond, length, distance, arm});
    });
    cells.push_back(polygon.cell());
    counts.push_back(facets.size() - before);
}

FacetedCells joined_cells(const std::vector<FacetedPiece>& pieces) {
    FacetedCells all{
        joined(pieces, &FacetedPiece::cells), joined(pieces, &FacetedPiece::facets), {0}};
    for (const FacetedPiece& piece : pieces)
        for (const std::size_t count : piece.counts)
            all.begin.push_back(all.begin.back() + count);
    return all;
}

FacetedCells faceted_cells(const State& state, const RigidBase& base,
                           std::span<const std::int32_t> rows, std::span<const double> lids) {
    assert(lids.size() == rows.size());
    const ConstDiscColumns d = disc_columns(state);
    const std::vector<double> radius = rock_radii(state);
    const double largest = radius.empty() ? 0.0 : std::ranges::max(radius);
    const double reach = reach_of(state), half = 0.5 * reach;
    const Cells cells(d.x, d.y, reach);
    const BasePlace place = base_place(state);
    const auto cut = [&](std::size_t k, std::size_t end) {
        FacetedPiece piece;
        PowerPolygon polygon;
        std::vector<std::pair<double, std::int32_t>> near; // square of the distance; row
        for (; k < end; ++k) {
            const auto i = static_cast<std::size_t>(rows[k]);
            near.clear();
            cells.for_each_near(d.x[i], d.y[i], [&](std::int32_t row) {
                const auto j = static_cast<std::size_t>(row);
                const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
                const double square = dx * dx + dy * dy;
                if (j != i && square <= reach * reach && square > 0.0)
                    near.emplace_back(square, row);
            });
            std::ranges::sort(near);
            polygon.begin(half);
            clip(polygon, base, place, {d.x[i], d.y[i]}, half);
            if (std::isfinite(lids[k]))
                polygon.clip({0.0, 1.0}, lids[k], facet_on_lid);
            double corners = polygon.reach();
            for (const auto& [square, row] : near) {
                const auto j = static_cast<std::size_t>(row);
                const double own = radius[i] * radius[i];
                // The nearest that a disc so far can cut is beyond all corners.
                const double nearest_cut = 0.5 * (square + own - largest * largest);
                if (nearest_cut > 0.0 && nearest_cut * nearest_cut > corners * square)
                    break;
                polygon.clip({d.x[j] - d.x[i], d.y[j] - d.y[i]},
                             0.5 * (square + own - radius[j] * radius[j]), row);
                corners = polygon.reach();
            }
            piece.add(polygon, i, d.x, d.y);
        }
        return piece;
    };
    return joined_cells(by_piece(rows.size(), 64, cut));
}

} // namespace listric::dem
