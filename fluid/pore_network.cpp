#include "fluid/pore_network.hpp"

#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace listric::fluid {

using namespace dem;

namespace {

/// Whether water flows between two discs: not across a gap.
bool is_near(double distance, double reach) {
    constexpr double most = 1.6; // sums of two radii
    return distance <= most * reach;
}

/// Length of the facet between two cells: of the part that both have, which differs where the
/// ground ends one.
double common_length(const PoreCells& cells, std::size_t first, const PowerFacet& facet,
                     std::size_t second) {
    const PowerFacet* const back = facet_between(cells, second, first);
    return back ? std::min(facet.length, back->length) : 0.0;
}

/// Whether the beds of two cells are told by one number: age in sediment, height at the start in
/// rock.
bool are_alike(const PoreCells& cells, std::size_t first, std::size_t second) {
    return !cells.rock[first] == !cells.rock[second];
}

/// Gradient of the plane by least squares through the ages of a cell and those that it touches.
Point age_gradient(const State& state, const PoreCells& cells, std::size_t k) {
    const ConstDiscColumns d = disc_columns(state);
    const auto i = static_cast<std::size_t>(cells.rows[k]);
    double xx = 0.0, xy = 0.0, yy = 0.0, xt = 0.0, yt = 0.0;
    for (const PowerFacet& facet : cells.faceted.of(k)) {
        if (facet.neighbour < 0)
            continue;
        const auto j = static_cast<std::size_t>(facet.neighbour);
        if (cells.cell_of[j] < 0 ||
            !are_alike(cells, k, static_cast<std::size_t>(cells.cell_of[j])))
            continue;
        const double x = d.x[j] - d.x[i], y = d.y[j] - d.y[i];
        const double later =
            cells.rock[k] ? d.start_y[j] - d.start_y[i] : d.start_travel[j] - d.start_travel[i];
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

/// Sum of a vector of every cell and of those alike that it touches.
std::vector<Point> summed_about(const PoreCells& cells, const std::vector<Point>& own) {
    std::vector<Point> sums = own;
    for (std::size_t k = 0; k < cells.count(); ++k)
        for (const PowerFacet& facet : cells.faceted.of(k)) {
            const std::int32_t other =
                facet.neighbour < 0 ? -1 : cells.cell_of[static_cast<std::size_t>(facet.neighbour)];
            if (other < 0 || !are_alike(cells, k, static_cast<std::size_t>(other)))
                continue;
            sums[k].x += own[static_cast<std::size_t>(other)].x;
            sums[k].y += own[static_cast<std::size_t>(other)].y;
        }
    return sums;
}

} // namespace

double Bedding::least(std::size_t cell) const {
    return matters() ? std::min(1.0, ratios[cell]) : 1.0;
}

double Bedding::beyond(std::size_t cell) const {
    return matters() ? std::abs(ratios[cell] - 1.0) : 0.0;
}

Point Bedding::axis(std::size_t cell) const {
    const Point n = normals[cell];
    return ratios[cell] > 1.0 ? Point{n.y, -n.x} : n;
}

Point Bedding::flow_of(std::size_t cell, Point gradient) const {
    if (!matters())
        return gradient;
    const Point n = normals[cell];
    const double ratio = ratios[cell];
    const double across = (1.0 - ratio) * (n.x * gradient.x + n.y * gradient.y);
    return {ratio * gradient.x + across * n.x, ratio * gradient.y + across * n.y};
}

Bedding bedding(const State& state, const PoreCells& cells, std::vector<double> ratios) {
    Bedding beds{std::move(ratios)};
    if (std::ranges::all_of(beds.ratios, [](double ratio) { return ratio == 1.0; }))
        return beds;
    std::vector<Point> gradients;
    for (std::size_t k = 0; k < cells.count(); ++k)
        gradients.push_back(age_gradient(state, cells, k));
    for (const Point& sum :
         summed_about(cells, summed_about(cells, summed_about(cells, gradients)))) {
        const double length = hypotenuse(sum.x, sum.y);
        beds.normals.push_back(length > 0.0 ? Point{sum.x / length, sum.y / length}
                                            : Point{0.0, 1.0});
    }
    return beds;
}

namespace {

/// What flow between two cells has to do with.
struct Neighbours {
    std::size_t second; ///< cell
    double length, factor;
};

/// Cells of the facets that water flows through.
class Links {
public:
    Links(const State& state, const PoreCells& cells, std::span<const FaultFactors> faults)
        : cells_(cells), faults_(faults), d_(disc_columns(state)), materials_(state.materials),
          radius_(rock_radii(state)) {}

    /// The cell beyond a facet; none: no water flows.
    std::optional<Neighbours> beyond(std::size_t k, const PowerFacet& facet) const {
        if (facet.neighbour < 0)
            return {};
        const auto i = static_cast<std::size_t>(cells_.rows[k]);
        const auto j = static_cast<std::size_t>(facet.neighbour);
        const std::int32_t other = cells_.cell_of[j];
        if (other < 0 || !is_near(facet.distance, radius_[i] + radius_[j]))
            return {};
        const auto m = static_cast<std::size_t>(other);
        const double length = common_length(cells_, k, facet, m);
        if (!(length > 0.0))
            return {};
        return Neighbours{m, length, factor(k, m)};
    }

private:
    double factor(std::size_t k, std::size_t m) const {
        if (faults_.empty())
            return 1.0;
        const bool here = is_weakened(k), there = is_weakened(m);
        if (here && there)
            return std::min(faults_[k].along, faults_[m].along);
        return here ? faults_[k].across : there ? faults_[m].across : 1.0;
    }

    bool is_weakened(std::size_t k) const {
        return is_weak(materials_, d_.material[static_cast<std::size_t>(cells_.rows[k])]);
    }

    const PoreCells& cells_;
    std::span<const FaultFactors> faults_;
    ConstDiscColumns d_;
    const std::vector<Material>& materials_;
    std::vector<double> radius_;
};

/// Adds what flows along the axes of the beds beyond the least permeability. Between a cell and one
/// that conducts less, pressure changes in that one.
void add_axes(const PoreCells& cells, std::span<const double> permeability, double viscosity,
              const Links& links, const Bedding& beds, FlowNetwork& network) {
    std::vector<std::pair<std::int32_t, double>> weights; // of the gradient in a cell, by cell
    for (std::size_t k = 0; k < cells.count(); ++k) {
        const double area = cells.faceted.cells[k].area;
        if (!(beds.beyond(k) > 0.0) || !(area > 0.0))
            continue;
        const Point axis = beds.axis(k);
        weights.assign(1, {static_cast<std::int32_t>(k), 0.0});
        double of_ground = 0.0;
        for (const PowerFacet& facet : cells.faceted.of(k)) {
            const double arm = axis.x * facet.arm.x + axis.y * facet.arm.y;
            if (facet.neighbour == facet_on_lid)
                of_ground += arm * facet.length / cells.ground_distances[k];
            const auto to = links.beyond(k, facet);
            if (!to)
                continue;
            const double here = permeability[k], there = permeability[to->second];
            const double share = 2.0 * there / (here + there) * std::min(1.0, to->factor);
            weights.emplace_back(static_cast<std::int32_t>(to->second),
                                 share * arm * to->length / facet.distance);
            weights.front().second -= weights.back().second;
        }
        weights.front().second -= of_ground;
        const double conducts = beds.beyond(k) * permeability[k] / (viscosity * area);
        for (std::size_t p = 0; p < weights.size(); ++p) {
            const auto [first, weight] = weights[p];
            network.drains[static_cast<std::size_t>(first)] -= conducts * weight * of_ground;
            for (std::size_t q = p + 1; q < weights.size(); ++q)
                network.links.push_back({std::min(first, weights[q].first),
                                         std::max(first, weights[q].first),
                                         -conducts * weight * weights[q].second});
        }
    }
}

/// One link for each pair, in the order of cells.
void merge(std::vector<FlowLink>& links) {
    const auto is_before = [](const FlowLink& a, const FlowLink& b) {
        return std::pair(a.first, a.second) < std::pair(b.first, b.second);
    };
    std::ranges::stable_sort(links, is_before);
    std::vector<FlowLink> merged;
    for (const FlowLink& link : links)
        if (merged.empty() || is_before(merged.back(), link))
            merged.push_back(link);
        else
            merged.back().conductance += link.conductance;
    links = std::move(merged);
}

} // namespace

FlowNetwork flow_network(const State& state, const PoreCells& cells,
                         std::span<const double> permeability, double viscosity,
                         std::span<const FaultFactors> faults, const Bedding& beds) {
    assert(permeability.size() == cells.count());
    const Links links(state, cells, faults);
    FlowNetwork network;
    network.drains.assign(cells.count(), 0.0);
    for (std::size_t k = 0; k < cells.count(); ++k) {
        const double here = beds.least(k) * permeability[k];
        network.drains[k] =
            here * cells.surface_lengths[k] / (viscosity * cells.ground_distances[k]);
        for (const PowerFacet& facet : cells.faceted.of(k)) {
            const auto to = links.beyond(k, facet);
            if (!to || to->second <= k)
                continue;
            const double there = beds.least(to->second) * permeability[to->second];
            const double both = 2.0 * here * there / (here + there);
            network.links.push_back(
                {static_cast<std::int32_t>(k), static_cast<std::int32_t>(to->second),
                 to->factor * both * to->length / (facet.distance * viscosity)});
        }
    }
    if (beds.matters()) {
        add_axes(cells, permeability, viscosity, links, beds, network);
        merge(network.links);
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

} // namespace listric::fluid
