#include "fluid/pore_cells.hpp"

#include "dem/columns.hpp"

#include <algorithm>
#include <limits>

namespace listric::fluid {

using namespace dem;

namespace {

/// Whether a cell is at the ground: open upward close below it.
bool is_at_ground(const State& state, const PoreCells& cells, std::size_t k) {
    constexpr double near_ground = 3.0; // mean radii
    return cells.depths[k] <= near_ground * state.mean_radius &&
           std::ranges::any_of(cells.faceted.of(k), [](const PowerFacet& f) {
               return f.neighbour == facet_open && f.arm.y > 0.0;
           });
}

/// Cuts the cells at the ground again, so that they end a radius above their discs' centres.
void end_at_ground(const State& state, const RigidBase& base, std::span<const double> radius,
                   PoreCells& cells) {
    std::vector<std::size_t> at_ground;
    std::vector<std::int32_t> rows;
    std::vector<double> lids;
    for (std::size_t k = 0; k < cells.count(); ++k)
        if (is_at_ground(state, cells, k)) {
            at_ground.push_back(k);
            rows.push_back(cells.rows[k]);
            lids.push_back(radius[static_cast<std::size_t>(cells.rows[k])]);
        }
    const FacetedCells cut = faceted_cells(state, base, rows, lids);
    FacetedCells all{cells.faceted.cells, {}, {0}};
    all.facets.reserve(cells.faceted.facets.size());
    std::size_t next = 0; // of those at the ground
    for (std::size_t k = 0; k < cells.count(); ++k) {
        const bool is_cut = next < at_ground.size() && at_ground[next] == k;
        const auto facets = is_cut ? cut.of(next) : cells.faceted.of(k);
        if (is_cut)
            all.cells[k] = cut.cells[next++];
        all.facets.insert(all.facets.end(), facets.begin(), facets.end());
        all.begin.push_back(all.facets.size());
    }
    cells.faceted = std::move(all);
}

} // namespace

PoreCells pore_cells(const State& state, const RigidBase& base, const WetSediment& sediment) {
    const ConstDiscColumns d = disc_columns(state);
    PoreCells cells;
    cells.cell_of.assign(d.x.size(), -1);
    const bool layered = sediment.has_rock() && state.discs.has(dem::columns::layer);
    const auto layer =
        layered ? state.discs.get(dem::columns::layer) : std::span<const std::uint8_t>{};
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const bool is_sediment = d.stratum[i] > 0;
        const PorousRock* const rock =
            layered && !is_sediment ? sediment.rock_of(layer[i]) : nullptr;
        if (!is_sediment && !rock)
            continue;
        cells.cell_of[i] = static_cast<std::int32_t>(cells.rows.size());
        cells.rows.push_back(static_cast<std::int32_t>(i));
        cells.rock.push_back(rock);
        cells.centres.push_back({d.x[i], d.y[i]});
    }
    cells.surface_lengths.assign(cells.count(), 0.0);
    if (cells.rows.empty()) {
        cells.faceted.begin = {0};
        return cells;
    }
    const WetGround ground(state, base.motion, sediment);
    for (const std::int32_t row : cells.rows) {
        const auto i = static_cast<std::size_t>(row);
        cells.pending.push_back(ground.pending(d.x[i]));
        cells.depths.push_back(ground.of_discs().depth({d.x[i], d.y[i]}));
    }
    constexpr double none = std::numeric_limits<double>::infinity();
    const std::vector<double> radius = rock_radii(state);
    cells.faceted =
        faceted_cells(state, base, cells.rows, std::vector<double>(cells.count(), none));
    end_at_ground(state, base, radius, cells);
    for (std::size_t k = 0; k < cells.count(); ++k) {
        const double r = radius[static_cast<std::size_t>(cells.rows[k])];
        cells.ground_distances.push_back(std::max(cells.depths[k] + cells.pending[k], 0.5 * r));
        for (const PowerFacet& facet : cells.faceted.of(k))
            if (facet.neighbour == facet_on_lid)
                cells.surface_lengths[k] += facet.length;
    }
    return cells;
}

const PowerFacet* facet_between(const PoreCells& cells, std::size_t first, std::size_t second) {
    for (const PowerFacet& facet : cells.faceted.of(first))
        if (facet.neighbour == cells.rows[second])
            return &facet;
    return nullptr;
}

Point pressure_arm(const PoreCells& cells, std::size_t k, const PowerFacet& facet,
                   std::size_t other) {
    if (cells.permeability.empty() || (!cells.rock[k] && !cells.rock[other]))
        return facet.arm;
    const Point normal = (1.0 / facet.distance) * (cells.centres[other] - cells.centres[k]);
    const double here = dot(normal, facet.arm);
    // Resistances of the two parts of the way.
    const double own = std::max(here, 0.0) * cells.permeability[other];
    const double others = std::max(facet.distance - here, 0.0) * cells.permeability[k];
    return facet.arm + (facet.distance * own / (own + others) - here) * normal;
}

std::vector<Point> pressure_gradients(const PoreCells& cells,
                                      std::span<const double> excess_pressure) {
    std::vector<Point> gradients(cells.count());
    for (std::size_t k = 0; k < cells.count(); ++k) {
        Point sum;
        for (const PowerFacet& facet : cells.faceted.of(k)) {
            double beyond = excess_pressure[k], distance = facet.distance;
            Point arm = facet.arm;
            if (facet.neighbour == facet_on_lid) {
                beyond = 0.0; // at the ground, which is not where the cell ends
                distance = cells.ground_distances[k];
            } else if (facet.neighbour >= 0) {
                const std::int32_t other = cells.cell_of[static_cast<std::size_t>(facet.neighbour)];
                if (other >= 0) {
                    beyond = excess_pressure[static_cast<std::size_t>(other)];
                    arm = pressure_arm(cells, k, facet, static_cast<std::size_t>(other));
                }
            }
            const double weight = (beyond - excess_pressure[k]) * facet.length / distance;
            sum.x += weight * arm.x;
            sum.y += weight * arm.y;
        }
        const double area = cells.faceted.cells[k].area;
        if (area > 0.0)
            gradients[k] = {sum.x / area, sum.y / area};
    }
    return gradients;
}

std::vector<Point> pore_forces(const State& state, const PoreCells& cells,
                               std::span<const double> volume,
                               std::span<const double> excess_pressure) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<Point> force(d.x.size());
    const std::vector<Point> gradients = pressure_gradients(cells, excess_pressure);
    for (std::size_t k = 0; k < cells.count(); ++k) {
        const auto i = static_cast<std::size_t>(cells.rows[k]);
        force[i].x -= volume[k] * gradients[k].x;
        force[i].y -= volume[k] * gradients[k].y;
        for (const PowerFacet& facet : cells.faceted.of(k)) {
            if (facet.neighbour < 0)
                continue;
            const auto j = static_cast<std::size_t>(facet.neighbour);
            if (cells.cell_of[j] >= 0)
                continue;
            const double pressure_times_share = excess_pressure[k] * facet.length / facet.distance;
            force[j].x += pressure_times_share * (d.x[j] - d.x[i]);
            force[j].y += pressure_times_share * (d.y[j] - d.y[i]);
        }
    }
    return force;
}

} // namespace listric::fluid
