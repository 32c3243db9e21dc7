#include "fluid/base_pressure.hpp"

#include "dem/base/place.hpp"
#include "dem/columns.hpp"
#include "fluid/sparse_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace listric::fluid {

using namespace dem;

namespace {

/// Where a facet on the base presses: a wall that it is on, or nodes.
struct Pressed {
    Point normal; ///< into the discs
    std::optional<TracePoint> on_nodes;
};

Pressed pressed_by(const RigidBase& base, const BasePlace& place, Point centre, double distance) {
    Pressed nearest_found{};
    double least = std::numeric_limits<double>::infinity();
    for (const Surface& surface : base.surfaces) {
        const auto foot = nearest(surface, place, centre);
        if (!foot || !(std::abs(foot->distance - distance) < least))
            continue;
        least = std::abs(foot->distance - distance);
        nearest_found = {foot->normal, std::nullopt};
        if (place.deforms(surface) && surface.follows == Follows::nodes)
            nearest_found.on_nodes = place.trace(surface).nearest(centre);
    }
    return nearest_found;
}

/// What two cells have in common of their facets, which the ground ends at different heights.
struct Common {
    std::size_t other;
    double length;
    Point here, there; ///< from the two centres to the middle, m
};

/// The wet cell beyond a facet.
std::optional<std::size_t> wet_beyond(const PoreCells& cells, const PowerFacet& facet) {
    const std::int32_t other =
        facet.neighbour < 0 ? -1 : cells.cell_of[static_cast<std::size_t>(facet.neighbour)];
    return other < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(other));
}

std::optional<Common> common(const PoreCells& cells, std::size_t k, const PowerFacet& facet) {
    const auto other = wet_beyond(cells, facet);
    const PowerFacet* const back = other ? facet_between(cells, *other, k) : nullptr;
    if (!back)
        return {};
    const Point way = cells.centres[*other] - cells.centres[k];
    if (facet.length <= back->length)
        return Common{*other, facet.length, facet.arm, facet.arm - way};
    return Common{*other, back->length, back->arm + way, back->arm};
}

/// What a cell has of its upper edge: its lid, and parts of facets above the ground that ends a
/// neighbour. Pressure there is linear up to the ground, as pressure_gradients() has it.
struct Edge {
    double length, pressure;
    Point arm;                        ///< from the centre to its middle, m
    Point normal;                     ///< outward
    std::optional<std::size_t> above; ///< the neighbour; none: it is the lid
};

template <class Visit>
void for_each_edge(const PoreCells& cells, std::span<const double> excess_pressure, std::size_t k,
                   Visit&& visit) {
    const auto at = [&](Point arm) {
        return excess_pressure[k] * (1.0 - arm.y / cells.ground_distances[k]);
    };
    for (const PowerFacet& facet : cells.faceted.of(k)) {
        if (facet.neighbour == facet_on_lid)
            visit(Edge{facet.length, at(facet.arm), facet.arm, {0.0, 1.0}, {}});
        const auto other = wet_beyond(cells, facet);
        if (!other)
            continue;
        const auto both = common(cells, k, facet);
        const double shared = both ? both->length : 0.0, length = facet.length - shared;
        constexpr double round_off = 1e-9;
        if (!(length > round_off * facet.length))
            continue;
        const Point arm =
            (1.0 / length) * (facet.length * facet.arm - shared * (both ? both->here : Point{}));
        const Point way = cells.centres[*other] - cells.centres[k];
        visit(Edge{length, at(arm), arm, (1.0 / facet.distance) * way, other});
    }
}

/// Pressure by cell, Pa, that rises from neighbour to neighbour as their slopes have it, in the
/// mean by least squares, and is zero at the ground. The weights are those with which what it
/// misses has no vertical sum, but for edges that overhang.
/// @param slopes  by cell, Pa/m
std::vector<double> fitted_pressure(const PoreCells& cells, std::span<const Point> slopes,
                                    std::span<const double> excess_pressure) {
    constexpr double tie = 1e-8; // of a facet's weight: where no way leads to the ground
    std::vector<MatrixEntry> pairs;
    std::vector<double> between, diagonal(cells.count(), tie), right_side(cells.count());
    double top = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < cells.count(); ++k)
        for (const PowerFacet& facet : cells.faceted.of(k))
            top = std::max(top, cells.centres[k].y + facet.arm.y);
    for (std::size_t k = 0; k < cells.count(); ++k) {
        right_side[k] += tie * excess_pressure[k];
        for_each_edge(cells, excess_pressure, k, [&](const Edge& edge) {
            const double weight =
                edge.length * std::max(0.0, edge.normal.y) / (top - cells.centres[k].y);
            diagonal[k] += weight;
            right_side[k] += weight * (edge.pressure - dot(slopes[k], edge.arm));
        });
        for (const PowerFacet& facet : cells.faceted.of(k)) {
            const auto both = common(cells, k, facet);
            if (!both || both->other < k)
                continue;
            const std::size_t m = both->other;
            const double weight = both->length / facet.distance;
            const double rise = dot(slopes[k], both->here) - dot(slopes[m], both->there);
            diagonal[k] += weight;
            diagonal[m] += weight;
            right_side[k] -= weight * rise;
            right_side[m] += weight * rise;
            pairs.push_back({static_cast<std::int32_t>(k), static_cast<std::int32_t>(m)});
            between.push_back(-weight);
        }
    }
    std::vector<double> pressure(cells.count());
    if (cells.count() > 0)
        SparseSolver(cells.count(), pairs).solve(diagonal, between, right_side, pressure);
    return pressure;
}

/// Pressure that the lift of wet discs adds up to.
struct Carried {
    std::vector<double> pressure; ///< by cell, Pa
    std::vector<Point> slopes;    ///< by cell, Pa/m

    double at(std::size_t k, Point arm) const { return pressure[k] + dot(slopes[k], arm); }
};

/// Minus force over area is the slope: what comes fills a cell above the smooth ground, where the
/// mud's own volume ends, and beyond its edges there is some more of that.
Carried carried_by(const PoreCells& cells, std::span<const double> excess_pressure,
                   std::span<const Point> force) {
    Carried carried;
    for (std::size_t k = 0; k < cells.count(); ++k) {
        Point inside = force[static_cast<std::size_t>(cells.rows[k])];
        for_each_edge(cells, excess_pressure, k, [&](const Edge& edge) {
            inside.y -= edge.pressure * edge.length * edge.normal.y;
        });
        const double area = cells.faceted.cells[k].area;
        carried.slopes.push_back(area > 0.0 ? (-1.0 / area) * inside : Point{});
    }
    carried.pressure = fitted_pressure(cells, carried.slopes, excess_pressure);
    return carried;
}

/// Makes the horizontal forces on wet discs those of that pressure: what one is given, its
/// neighbours give. Those of facets on rock and base are to come.
void push_sideways(const PoreCells& cells, std::span<const double> excess_pressure,
                   const Carried& carried, std::span<Point> force) {
    const auto on = [&](std::size_t k) -> double& {
        return force[static_cast<std::size_t>(cells.rows[k])].x;
    };
    for (std::size_t k = 0; k < cells.count(); ++k)
        on(k) = 0.0;
    for (std::size_t k = 0; k < cells.count(); ++k) {
        for (const PowerFacet& facet : cells.faceted.of(k))
            if (const auto both = common(cells, k, facet))
                on(k) -= (carried.pressure[both->other] - carried.pressure[k]) * both->length /
                         facet.distance * both->here.x;
        // What comes over a neighbour bears the pressure of the facet above it.
        for_each_edge(cells, excess_pressure, k, [&](const Edge& edge) {
            if (edge.above)
                on(*edge.above) += carried.pressure[k] * edge.length * edge.normal.x;
        });
    }
}

/// What presses on rock and base.
struct Below {
    std::vector<double> on_rock; ///< by disc: magnitude of pressure times length, N
    double size = 0.0;           ///< of all, N
    Point on_base = {};          ///< sum of forces, on walls too, N
};

/// Fills the nodes' columns and the forces on dry discs, and adds to wet ones what they have of
/// their facets there.
Below press(State& state, const RigidBase& base, const PoreCells& cells,
            std::span<const double> excess_pressure, const Carried& carried,
            std::span<Point> force) {
    const BasePlace place = base_place(state);
    const auto node_x = state.base_nodes.get(dem::columns::excess_x);
    const auto node_y = state.base_nodes.get(dem::columns::excess_y);
    const auto node_size = state.base_nodes.get(dem::columns::excess_size);
    for (const auto& column : {node_x, node_y, node_size})
        std::ranges::fill(column, 0.0);
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    Below below{std::vector<double>(force.size(), 0.0)};
    for (std::size_t k = 0; k < cells.count(); ++k)
        for (const PowerFacet& facet : cells.faceted.of(k)) {
            const bool rock = facet.neighbour >= 0 && !wet_beyond(cells, facet);
            if (!rock && facet.neighbour != facet_on_base)
                continue;
            const double all = std::abs(excess_pressure[k]) * facet.length;
            const double push = carried.at(k, facet.arm) * facet.length;
            const double beyond = push - carried.pressure[k] * facet.length;
            const Point centre = cells.centres[k];
            Point& own = force[static_cast<std::size_t>(cells.rows[k])];
            if (rock) {
                const auto j = static_cast<std::size_t>(facet.neighbour);
                const Point outward = (1.0 / facet.distance) * (Point{d.x[j], d.y[j]} - centre);
                own.x -= beyond * outward.x;
                force[j] = force[j] + push * outward;
                below.on_rock[j] += all;
                below.size += all;
                continue;
            }
            const Pressed on = pressed_by(base, place, centre, facet.distance);
            own.x += beyond * on.normal.x;
            below.on_base = below.on_base - push * on.normal;
            if (!on.on_nodes)
                continue;
            below.size += all;
            for (std::size_t m = 0; m < 3 && on.on_nodes->node + m < node_x.size(); ++m) {
                const std::size_t node = on.on_nodes->node + m;
                node_x[node] -= on.on_nodes->weight[m] * push * on.normal.x;
                node_y[node] -= on.on_nodes->weight[m] * push * on.normal.y;
                node_size[node] += on.on_nodes->weight[m] * all;
            }
        }
    return below;
}

} // namespace

void add_base_pressure(State& state) {
    state.discs.add(dem::columns::lift);
    for (const auto& column :
         {dem::columns::excess_x, dem::columns::excess_y, dem::columns::excess_size})
        state.base_nodes.add(column);
}

void lift_what_comes(const PoreCells& cells, std::span<const double> excess_pressure,
                     std::span<Point> force) {
    for (std::size_t k = 0; k < cells.count(); ++k)
        for_each_edge(cells, excess_pressure, k, [&](const Edge& edge) {
            Point& lift = force[static_cast<std::size_t>(cells.rows[k])];
            lift.y += edge.pressure * edge.length * edge.normal.y;
            if (!edge.above)
                lift.y += excess_pressure[k] * edge.length * (edge.arm.y - cells.depths[k]) /
                          cells.ground_distances[k];
        });
}

double press_base(State& state, const RigidBase& base, const PoreCells& cells,
                  std::span<const double> excess_pressure, std::span<Point> force) {
    const Carried carried = carried_by(cells, excess_pressure, force);
    push_sideways(cells, excess_pressure, carried, force);
    for (std::size_t i = 0; i < force.size(); ++i)
        if (cells.cell_of[i] < 0)
            force[i] = {};
    const Below below = press(state, base, cells, excess_pressure, carried, force);
    if (!(below.size > 0.0))
        return 0.0;
    Point sum = below.on_base;
    for (const Point& f : force)
        sum = sum + f;
    const Point missing = (-1.0 / below.size) * sum;
    for (std::size_t i = 0; i < force.size(); ++i)
        force[i] = force[i] + below.on_rock[i] * missing;
    const auto node_x = state.base_nodes.get(dem::columns::excess_x);
    const auto node_y = state.base_nodes.get(dem::columns::excess_y);
    const auto node_size = state.base_nodes.get(dem::columns::excess_size);
    for (std::size_t k = 0; k < node_x.size(); ++k) {
        node_x[k] += missing.x * node_size[k];
        node_y[k] += missing.y * node_size[k];
    }
    return norm(missing);
}

} // namespace listric::fluid
