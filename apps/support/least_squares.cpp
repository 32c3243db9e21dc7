#include "apps/support/least_squares.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace listric {

namespace {

/// Takes a multiple of one column off another.
void take_off(std::vector<double>& column, double factor, const std::vector<double>& of) {
    for (std::size_t k = 0; k < column.size(); ++k)
        column[k] -= factor * of[k];
}

} // namespace

double dot(std::span<const double> a, std::span<const double> b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

LeastSquares::LeastSquares(const std::vector<std::vector<double>>& columns)
    : order_(columns.size()) {
    assert(!columns.empty());
    std::iota(order_.begin(), order_.end(), 0);
    std::vector<std::vector<double>> left = columns;
    double round_off = 0.0;
    for (std::size_t step = 0; step < std::min(columns.size(), columns[0].size()); ++step) {
        const auto size = [&](std::size_t k) { return dot(left[k], left[k]); };
        const auto next = order_.begin() + static_cast<std::ptrdiff_t>(step);
        std::iter_swap(next, std::ranges::max_element(next, order_.end(), {}, size));
        std::vector<double>& column = left[*next];
        // Twice is enough: the second time takes off what round-off of the first has left.
        std::vector<double> row(columns.size());
        for (std::size_t k = 0; k < step; ++k)
            take_off(column, dot(orthonormal_[k], column), orthonormal_[k]);
        const double length = std::sqrt(dot(column, column));
        if (step == 0)
            round_off = length * static_cast<double>(columns.size() + columns[0].size()) *
                        std::numeric_limits<double>::epsilon();
        if (length <= round_off)
            break;
        for (double& value : column)
            value /= length;
        row[*next] = length;
        for (auto other = next + 1; other != order_.end(); ++other) {
            row[*other] = dot(column, left[*other]);
            take_off(left[*other], row[*other], column);
        }
        orthonormal_.push_back(column);
        triangle_.push_back(std::move(row));
    }
}

double LeastSquares::residual(std::span<const double> values) const {
    std::vector<double> left(values.begin(), values.end());
    for (const std::vector<double>& column : orthonormal_)
        take_off(left, dot(column, left), column);
    return dot(left, left);
}

std::optional<std::vector<double>> LeastSquares::weights(std::size_t column) const {
    // The combination of the triangle's rows that is 1 in the column and 0 in all others.
    constexpr double nearly = 1e-8;
    std::vector<double> share(rank()), made(order_.size());
    for (std::size_t k = 0; k < rank(); ++k) {
        const double wanted = order_[k] == column ? 1.0 : 0.0;
        share[k] = (wanted - made[order_[k]]) / triangle_[k][order_[k]];
        for (std::size_t other = k; other < order_.size(); ++other)
            made[order_[other]] += share[k] * triangle_[k][order_[other]];
    }
    for (std::size_t k = 0; k < made.size(); ++k)
        if (std::abs(made[k] - (k == column ? 1.0 : 0.0)) > nearly)
            return std::nullopt;
    std::vector<double> weights(orthonormal_.empty() ? 0 : orthonormal_[0].size());
    for (std::size_t k = 0; k < rank(); ++k)
        take_off(weights, -share[k], orthonormal_[k]);
    return weights;
}

} // namespace listric
