#include "fluid/base_pressure.hpp"

#include "dem/base/place.hpp"
#include "dem/columns.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <cmath>

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

} // namespace

void add_base_pressure(State& state) {
    state.discs.add(dem::columns::lift);
    for (const auto& column :
         {dem::columns::excess_x, dem::columns::excess_y, dem::columns::excess_size})
        state.base_nodes.add(column);
}

double lifted_share(const PoreCells& cells, std::span<const Point> force,
                    std::span<const double> excess_pressure) {
    const std::vector<Point> gradients = pressure_gradients(cells, excess_pressure);
    Point acts, of_cells;
    for (std::size_t k = 0; k < cells.count(); ++k) {
        const Point on_disc = force[static_cast<std::size_t>(cells.rows[k])];
        const double area = cells.faceted.cells[k].area;
        acts.x += on_disc.x;
        acts.y += on_disc.y;
        of_cells.x -= area * gradients[k].x;
        of_cells.y -= area * gradients[k].y;
    }
    const double square = of_cells.x * of_cells.x + of_cells.y * of_cells.y;
    return square > 0.0 ? (acts.x * of_cells.x + acts.y * of_cells.y) / square : 1.0;
}

void lift_what_comes(const PoreCells& cells, std::span<const double> excess_pressure, double share,
                     std::vector<Point>& force) {
    for (std::size_t k = 0; k < cells.count(); ++k)
        for (const PowerFacet& facet : cells.faceted.of(k)) {
            if (facet.neighbour != facet_on_lid)
                continue;
            // Pressure is linear up to the ground, as pressure_gradients() has it.
            const double pressure_over_distance =
                share * excess_pressure[k] * facet.length / cells.ground_distances[k];
            Point& lift = force[static_cast<std::size_t>(cells.rows[k])];
            lift.x -= pressure_over_distance * facet.arm.x;
            lift.y += pressure_over_distance * (cells.ground_distances[k] - facet.arm.y);
        }
}

double press_base(State& state, const RigidBase& base, const PoreCells& cells,
                  std::span<const double> excess_pressure, double share,
                  std::vector<Point>& force) {
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    const BasePlace place = base_place(state);
    const auto node_x = state.base_nodes.get(dem::columns::excess_x);
    const auto node_y = state.base_nodes.get(dem::columns::excess_y);
    const auto node_size = state.base_nodes.get(dem::columns::excess_size);
    for (const auto& column : {node_x, node_y, node_size})
        std::ranges::fill(column, 0.0);
    std::vector<double> on_rock(force.size(), 0.0);
    double size = 0.0;
    Point sum; // of all forces, those on walls too
    for (std::size_t k = 0; k < cells.count(); ++k)
        for (const PowerFacet& facet : cells.faceted.of(k)) {
            const double all = std::abs(excess_pressure[k]) * facet.length;
            if (facet.neighbour >= 0) {
                const auto j = static_cast<std::size_t>(facet.neighbour);
                if (cells.cell_of[j] < 0) {
                    on_rock[j] += all;
                    size += all;
                }
                continue;
            }
            if (facet.neighbour != facet_on_base)
                continue;
            const auto i = static_cast<std::size_t>(cells.rows[k]);
            const Pressed on = pressed_by(base, place, {d.x[i], d.y[i]}, facet.distance);
            const double counts = share * excess_pressure[k] * facet.length;
            sum.x -= counts * on.normal.x;
            sum.y -= counts * on.normal.y;
            if (!on.on_nodes)
                continue;
            size += all;
            for (std::size_t m = 0; m < 3 && on.on_nodes->node + m < node_x.size(); ++m) {
                const std::size_t node = on.on_nodes->node + m;
                node_x[node] -= on.on_nodes->weight[m] * counts * on.normal.x;
                node_y[node] -= on.on_nodes->weight[m] * counts * on.normal.y;
                node_size[node] += on.on_nodes->weight[m] * all;
            }
        }
    for (std::size_t i = 0; i < force.size(); ++i) {
        if (cells.cell_of[i] < 0)
            force[i] = {share * force[i].x, share * force[i].y};
        sum.x += force[i].x;
        sum.y += force[i].y;
    }
    if (!(size > 0.0))
        return 0.0;
    const Point missing{-sum.x / size, -sum.y / size};
    for (std::size_t i = 0; i < force.size(); ++i) {
        force[i].x += missing.x * on_rock[i];
        force[i].y += missing.y * on_rock[i];
    }
    for (std::size_t k = 0; k < node_x.size(); ++k) {
        node_x[k] += missing.x * node_size[k];
        node_y[k] += missing.y * node_size[k];
    }
    return hypotenuse(missing.x, missing.y);
}

} // namespace listric::fluid
