#include "apps/studies/least_squares.hpp"

#include <Eigen/QR>

#include <cassert>
#include <cmath>
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

LeastSquares::LeastSquares(const std::vector<std::vector<double>>& columns) {
    assert(!columns.empty());
    const auto count = static_cast<Eigen::Index>(columns.size());
    const auto rows = static_cast<Eigen::Index>(columns[0].size());
    Eigen::MatrixXd matrix(rows, count);
    for (Eigen::Index k = 0; k < count; ++k)
        matrix.col(k) = Eigen::VectorXd::Map(columns[static_cast<std::size_t>(k)].data(), rows);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(matrix);
    const Eigen::Index rank = factors.rank();
    const Eigen::MatrixXd orthonormal =
        factors.householderQ() * Eigen::MatrixXd::Identity(rows, rank);
    for (Eigen::Index k = 0; k < count; ++k)
        order_.push_back(static_cast<std::size_t>(factors.colsPermutation().indices()[k]));
    for (Eigen::Index k = 0; k < rank; ++k) {
        const auto column = orthonormal.col(k);
        orthonormal_.emplace_back(column.begin(), column.end());
        triangle_.emplace_back(columns.size());
        for (Eigen::Index other = k; other < count; ++other)
            triangle_.back()[order_[static_cast<std::size_t>(other)]] = factors.matrixR()(k, other);
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
