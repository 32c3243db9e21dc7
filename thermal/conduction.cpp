#include "thermal/conduction.hpp"

#include "dem/cycle_physics.hpp"
#include "fluid/sparse_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace listric::thermal {

using namespace dem;

namespace {

/// Length that both cells have of their facet: the ground may end one of them.
double common_length(const FacetedCells& cells, std::size_t first, const PowerFacet& facet) {
    for (const PowerFacet& back : cells.of(static_cast<std::size_t>(facet.neighbour)))
        if (back.neighbour == static_cast<std::int32_t>(first))
            return std::min(facet.length, back.length);
    return 0.0;
}

/// The nearest site with a cell, to one that its neighbours have left none.
std::int32_t nearest_to(const Sites& sites, const FacetedCells& cells, std::size_t hidden) {
    double least = std::numeric_limits<double>::infinity();
    std::int32_t nearest = -1;
    for (std::size_t j = 0; j < sites.count(); ++j) {
        const double dx = sites.x[j] - sites.x[hidden], dy = sites.y[j] - sites.y[hidden];
        if (!cells.of(j).empty() && dx * dx + dy * dy < least) {
            least = dx * dx + dy * dy;
            nearest = static_cast<std::int32_t>(j);
        }
    }
    return nearest;
}

} // namespace

HeatNetwork heat_network(const Sites& sites, const FacetedCells& cells,
                         std::span<const double> conductivity, std::span<const double> blanket) {
    assert(conductivity.size() == sites.count());
    assert(blanket.empty() || blanket.size() == sites.count());
    HeatNetwork network{
        {}, std::vector<double>(sites.count(), 0.0), std::vector<double>(sites.count(), 0.0)};
    for (std::size_t i = 0; i < sites.count(); ++i) {
        const double here = conductivity[i];
        const auto facets = cells.of(i);
        // It has the temperature of the cell that it lies in.
        if (facets.empty()) {
            if (const std::int32_t other = nearest_to(sites, cells, i); other >= 0)
                network.links.push_back({static_cast<std::int32_t>(i), other, here});
            continue;
        }
        for (const PowerFacet& facet : facets) {
            if (facet.neighbour == facet_on_lid)
                network.ground[i] +=
                    facet.length / (facet.distance / here + (blanket.empty() ? 0.0 : blanket[i]));
            else if (facet.neighbour == facet_on_base)
                network.floor[i] += here * facet.length / facet.distance;
            if (facet.neighbour <= static_cast<std::int32_t>(i))
                continue;
            const auto j = static_cast<std::size_t>(facet.neighbour);
            const double there = conductivity[j];
            const double way = std::clamp( // to the facet
                (facet.arm.x * (sites.x[j] - sites.x[i]) +
                 facet.arm.y * (sites.y[j] - sites.y[i])) /
                    facet.distance,
                0.0, facet.distance);
            if (const double length = common_length(cells, i, facet); length > 0.0)
                network.links.push_back({static_cast<std::int32_t>(i), facet.neighbour,
                                         length / (way / here + (facet.distance - way) / there)});
        }
    }
    return network;
}

void solve_iteratively(std::span<const HeatLink> links, std::span<const double> diagonal,
                       std::span<const double> right_side, std::span<double> solution) {
    const std::size_t n = diagonal.size();
    std::vector<double> residual(n), way(n), image(n), preconditioned(n);
    const auto multiply = [&](std::span<const double> v) {
        for (std::size_t i = 0; i < n; ++i)
            image[i] = diagonal[i] * v[i];
        for (const HeatLink& link : links) {
            const auto a = static_cast<std::size_t>(link.first);
            const auto b = static_cast<std::size_t>(link.second);
            image[a] -= link.conductance * v[b];
            image[b] -= link.conductance * v[a];
        }
    };
    const auto product = [n](std::span<const double> a, std::span<const double> b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < n; ++i)
            sum += a[i] * b[i];
        return sum;
    };
    multiply(solution);
    for (std::size_t i = 0; i < n; ++i) {
        residual[i] = right_side[i] - image[i];
        preconditioned[i] = residual[i] / diagonal[i];
    }
    way = preconditioned;
    double rho = product(residual, preconditioned);
    constexpr double tolerance = 1e-14;
    const double least = tolerance * tolerance * product(right_side, right_side);
    for (std::size_t step = 0; product(residual, residual) > least; ++step) {
        if (step > 20 * n)
            throw NumericalFailure("heat: conjugate gradients do not converge");
        multiply(way);
        const double stride = rho / product(way, image);
        for (std::size_t i = 0; i < n; ++i) {
            solution[i] += stride * way[i];
            residual[i] -= stride * image[i];
            preconditioned[i] = residual[i] / diagonal[i];
        }
        const double next = product(residual, preconditioned);
        for (std::size_t i = 0; i < n; ++i)
            way[i] = preconditioned[i] + next / rho * way[i];
        rho = next;
    }
}

namespace {

/// Solves conduction again and again, for right sides of one matrix.
class Solver {
public:
    Solver(const HeatNetwork& network, std::vector<double> diagonal)
        : network_(network), diagonal_(std::move(diagonal)) {
        for (const HeatLink& link : network.links) {
            diagonal_[static_cast<std::size_t>(link.first)] += link.conductance;
            diagonal_[static_cast<std::size_t>(link.second)] += link.conductance;
        }
        if (diagonal_.size() > most_direct)
            return;
        std::vector<fluid::MatrixEntry> entries;
        std::vector<double> values;
        for (const HeatLink& link : network.links) {
            entries.push_back({link.first, link.second});
            values.push_back(-link.conductance);
        }
        direct_ = std::make_unique<fluid::SparseSolver>(diagonal_.size(), entries);
        if (!direct_->factor(diagonal_, values))
            throw NumericalFailure("heat: the matrix of conduction is not positive definite");
    }

    void solve(std::span<const double> right_side, std::span<double> temperature) const {
        if (direct_)
            direct_->solve(right_side, temperature);
        else
            solve_iteratively(network_.links, diagonal_, right_side, temperature);
    }

private:
    const HeatNetwork& network_;
    std::vector<double> diagonal_;
    std::unique_ptr<fluid::SparseSolver> direct_;
};

} // namespace

HeatFlows conduct(const HeatNetwork& network, std::span<const double> capacity,
                  std::span<const double> production, const EndTemperatures& ends, double seconds,
                  std::span<double> temperature) {
    constexpr double most_parts = 400.0;
    const std::size_t n = temperature.size();
    const double parts = std::clamp(std::ceil(seconds / longest_part), 1.0, most_parts);
    const double part = seconds / parts;
    std::vector<double> diagonal(n), right_side(n);
    for (std::size_t i = 0; i < n; ++i)
        diagonal[i] = capacity[i] / part + network.ground[i] + network.floor[i];
    const Solver solver(network, diagonal);
    HeatFlows flows;
    for (double k = 0.0; k < parts; ++k) {
        for (std::size_t i = 0; i < n; ++i)
            right_side[i] = capacity[i] / part * temperature[i] + production[i] +
                            network.ground[i] * ends.ground + network.floor[i] * ends.floor;
        solver.solve(right_side, temperature);
        for (std::size_t i = 0; i < n; ++i) {
            flows.produced += part * production[i];
            flows.through_ground += part * network.ground[i] * (temperature[i] - ends.ground);
            flows.through_floor += part * network.floor[i] * (ends.floor - temperature[i]);
        }
    }
    return flows;
}

} // namespace listric::thermal
