#include "dem/contacts/power_cell.hpp"

#include "dem/base/place.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/threads/shared_loop.hpp"

namespace listric::dem {

namespace {

struct Corner {
    Point p;
    bool open; ///< the edge that leaves this corner is part of the starting square
};

/// Keeps the part of the polygon with n . p <= offset.
void clip(std::vector<Corner>& polygon, std::vector<Corner>& scratch, Point n, double offset) {
    scratch.clear();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Corner& a = polygon[k];
        const Corner& b = polygon[(k + 1) % polygon.size()];
        const double outside_a = n.x * a.p.x + n.y * a.p.y - offset;
        const double outside_b = n.x * b.p.x + n.y * b.p.y - offset;
        if (outside_a <= 0.0)
            scratch.push_back(a);
        if ((outside_a <= 0.0) == (outside_b <= 0.0))
            continue;
        const double share = outside_a / (outside_a - outside_b);
        const Point cut{a.p.x + share * (b.p.x - a.p.x), a.p.y + share * (b.p.y - a.p.y)};
        scratch.push_back({cut, outside_a <= 0.0 ? false : a.open});
    }
    polygon.swap(scratch);
}

} // namespace

std::vector<double> rock_radii(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<double> radius(d.radius.begin(), d.radius.end());
    if (state.discs.has("rock_radius")) {
        const auto rock = state.discs.get<double>("rock_radius");
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
    const double reach = 5.0 * state.mean_radius;
    const Cells cells(d.x, d.y, reach);
    std::vector<PowerCell> result(rows.size());
    const BasePlace place = base_place(state);
    in_pieces(rows.size(), 64, [&](std::size_t k, std::size_t end) {
        std::vector<Corner> polygon, scratch;
        for (; k < end; ++k) {
            const auto i = static_cast<std::size_t>(rows[k]);
            const double half = 0.5 * reach;
            polygon = {{{-half, -half}, true},
                       {{half, -half}, true},
                       {{half, half}, true},
                       {{-half, half}, true}};
            for (const Surface& s : base.surfaces)
                if (const auto foot = nearest(s, place, {d.x[i], d.y[i]});
                    foot && foot->distance < half)
                    clip(polygon, scratch, {-foot->normal.x, -foot->normal.y}, foot->distance);
            cells.for_each_near(d.x[i], d.y[i], [&](std::int32_t row) {
                const auto j = static_cast<std::size_t>(row);
                const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
                const double square = dx * dx + dy * dy;
                if (j == i || square > reach * reach || square == 0.0)
                    return;
                clip(polygon, scratch, {dx, dy},
                     0.5 * (square + radius[i] * radius[i] - radius[j] * radius[j]));
            });
            double twice = 0.0;
            bool closed = true;
            for (std::size_t c = 0; c < polygon.size(); ++c) {
                const Corner& a = polygon[c];
                const Corner& b = polygon[(c + 1) % polygon.size()];
                twice += a.p.x * b.p.y - a.p.y * b.p.x;
                closed = closed && !a.open;
            }
            result[k] = {0.5 * twice, closed && polygon.size() > 2};
        }
    });
    return result;
}

} // namespace listric::dem
