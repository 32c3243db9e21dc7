#include "fluid/pore_cells.hpp"

#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

namespace listric::fluid {

using namespace dem;

namespace {

/// Whether water flows between two discs: not across a gap.
bool is_near(double distance, double reach) {
    constexpr double most = 1.6; // sums of two radii
    return distance <= most * reach;
}

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

/// Length of the facet between two cells: of the part that both have, which differs where the
/// ground ends one.
double common_length(const PoreCells& cells, std::size_t first, const PowerFacet& facet,
                     std::size_t second) {
    for (const PowerFacet& back : cells.faceted.of(second))
        if (back.neighbour == cells.rows[first])
            return std::min(facet.length, back.length);
    return 0.0;
}

} // namespace

PoreCells pore_cells(const State& state, const RigidBase& base, const WetSediment& sediment) {
    const ConstDiscColumns d = disc_columns(state);
    PoreCells cells;
    cells.cell_of.assign(d.x.size(), -1);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] > 0) {
            cells.cell_of[i] = static_cast<std::int32_t>(cells.rows.size());
            cells.rows.push_back(static_cast<std::int32_t>(i));
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

double Bedding::factor(std::size_t cell, Point direction) const {
    if (normals.empty())
        return 1.0;
    const double across = normals[cell].x * direction.x + normals[cell].y * direction.y;
    return ratio + (1.0 - ratio) * across * across;
}

Point Bedding::flow_of(std::size_t cell, Point gradient) const {
    if (normals.empty())
        return gradient;
    const Point n = normals[cell];
    const double across = (1.0 - ratio) * (n.x * gradient.x + n.y * gradient.y);
    return {ratio * gradient.x + across * n.x, ratio * gradient.y + across * n.y};
}

namespace {

/// Gradient of the plane by least squares through the ages of a cell and those that it touches.
Point age_gradient(const State& state, const PoreCells& cells, std::size_t k) {
    const ConstDiscColumns d = disc_columns(state);
    const auto i = static_cast<std::size_t>(cells.rows[k]);
    double xx = 0.0, xy = 0.0, yy = 0.0, xt = 0.0, yt = 0.0;
    for (const PowerFacet& facet : cells.faceted.of(k)) {
        if (facet.neighbour < 0)
            continue;
        const auto j = static_cast<std::size_t>(facet.neighbour);
        if (cells.cell_of[j] < 0)
            continue;
        const double x = d.x[j] - d.x[i], y = d.y[j] - d.y[i];
        const double later = d.start_travel[j] - d.start_travel[i];
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xt += x * later;
        yt += y * later;
    }
    const double determinant = xx * yy - xy * xy;
    constexpr double least = 1e-3; // of that of neighbours all around: they are on a line
    if (!(determinant > least * (xx + yy) * (xx + yy)))
        return {};
    return {(yy * xt - xy * yt) / determinant, (xx * yt - xy * xt) / determinant};
}

} // namespace

Bedding bedding(const State& state, const PoreCells& cells, double ratio) {
    Bedding beds{ratio};
    if (ratio == 1.0)
        return beds;
    std::vector<Point> own;
    for (std::size_t k = 0; k < cells.count(); ++k)
        own.push_back(age_gradient(state, cells, k));
    for (std::size_t k = 0; k < cells.count(); ++k) {
        Point sum = own[k];
        for (const PowerFacet& facet : cells.faceted.of(k)) {
            const std::int32_t other =
                facet.neighbour < 0 ? -1 : cells.cell_of[static_cast<std::size_t>(facet.neighbour)];
            if (other < 0)
                continue;
            sum.x += own[static_cast<std::size_t>(other)].x;
            sum.y += own[static_cast<std::size_t>(other)].y;
        }
        const double length = hypotenuse(sum.x, sum.y);
        beds.normals.push_back(length > 0.0 ? Point{sum.x / length, sum.y / length}
                                            : Point{0.0, 1.0});
    }
    return beds;
}

FlowNetwork flow_network(const State& state, const PoreCells& cells,
                         std::span<const double> permeability, double viscosity,
                         const FaultFactors& faults, const Bedding& beds) {
    assert(permeability.size() == cells.count());
    const ConstDiscColumns d = disc_columns(state);
    const std::vector<double> radius = rock_radii(state);
    FlowNetwork network;
    network.drains.assign(cells.count(), 0.0);
    for (std::size_t k = 0; k < cells.count(); ++k) {
        const auto i = static_cast<std::size_t>(cells.rows[k]);
        network.drains[k] = beds.factor(k, {0.0, 1.0}) * permeability[k] *
                            cells.surface_lengths[k] / (viscosity * cells.ground_distances[k]);
        for (const PowerFacet& facet : cells.faceted.of(k)) {
            if (facet.neighbour < 0)
                continue;
            const auto j = static_cast<std::size_t>(facet.neighbour);
            const std::int32_t other = cells.cell_of[j];
            if (other <= static_cast<std::int32_t>(k) ||
                !is_near(facet.distance, radius[i] + radius[j]))
                continue;
            const auto m = static_cast<std::size_t>(other);
            const double length = common_length(cells, k, facet, m);
            const int weakened =
                is_weak(state.materials, d.material[i]) + is_weak(state.materials, d.material[j]);
            const double factor = weakened == 2   ? faults.along
                                  : weakened == 1 ? faults.across
                                                  : 1.0;
            const double reach = hypotenuse(d.x[j] - d.x[i], d.y[j] - d.y[i]);
            const Point direction{(d.x[j] - d.x[i]) / reach, (d.y[j] - d.y[i]) / reach};
            const double here = beds.factor(k, direction) * permeability[k];
            const double there = beds.factor(m, direction) * permeability[m];
            const double both = 2.0 * here * there / (here + there);
            if (length > 0.0)
                network.links.push_back({static_cast<std::int32_t>(k), other,
                                         factor * both * length / (facet.distance * viscosity)});
        }
    }
    return network;
}

std::size_t enclosed_cells(const FlowNetwork& network) {
    std::vector<std::int32_t> parent(network.cells());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t cell) {
        while (parent[static_cast<std::size_t>(cell)] != cell)
            cell = parent[static_cast<std::size_t>(cell)] =
                parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(cell)])];
        return cell;
    };
    for (const FlowLink& link : network.links)
        parent[static_cast<std::size_t>(root(link.first))] = root(link.second);
    std::vector<bool> drained(network.cells(), false);
    const auto root_of = [&](std::size_t k) {
        return static_cast<std::size_t>(root(static_cast<std::int32_t>(k)));
    };
    for (std::size_t k = 0; k < network.cells(); ++k)
        if (network.drains[k] > 0.0)
            drained[root_of(k)] = true;
    std::size_t enclosed = 0;
    for (std::size_t k = 0; k < network.cells(); ++k)
        enclosed += !drained[root_of(k)];
    return enclosed;
}

std::vector<Point> pressure_gradients(const PoreCells& cells,
                                      std::span<const double> excess_pressure) {
    std::vector<Point> gradients(cells.count());
    for (std::size_t k = 0; k < cells.count(); ++k) {
        Point sum;
        for (const PowerFacet& facet : cells.faceted.of(k)) {
            double beyond = excess_pressure[k], distance = facet.distance;
            if (facet.neighbour == facet_on_lid) {
                beyond = 0.0; // at the ground, which is not where the cell ends
                distance = cells.ground_distances[k];
            } else if (facet.neighbour >= 0) {
                const std::int32_t other = cells.cell_of[static_cast<std::size_t>(facet.neighbour)];
                if (other >= 0)
                    beyond = excess_pressure[static_cast<std::size_t>(other)];
            }
            const double weight = (beyond - excess_pressure[k]) * facet.length / distance;
            sum.x += weight * facet.arm.x;
            sum.y += weight * facet.arm.y;
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
