#pragma once

#include <optional>
#include <span>
#include <vector>

namespace listric {

/// Columns of a linear model as orthonormal columns times an upper triangle, the largest that is
/// left first: Eigen's column-pivoting QR, which is dear to compile and so is in this unit alone.
/// What is left of a column that others make up is round-off; it adds nothing to the rank.
class LeastSquares {
public:
    /// @param columns  of equal lengths, at least one
    explicit LeastSquares(const std::vector<std::vector<double>>& columns);

    std::size_t rank() const { return orthonormal_.size(); }

    /// Sum of squares of what no combination of the columns can make up.
    double residual(std::span<const double> values) const;

    /// Weights of the values whose sum is the best estimate of a column's coefficient; none:
    /// columns hang together so that the values do not tell it.
    std::optional<std::vector<double>> weights(std::size_t column) const;

private:
    std::vector<std::size_t> order_;               ///< columns as they were taken
    std::vector<std::vector<double>> orthonormal_; ///< `rank`
    std::vector<std::vector<double>> triangle_;    ///< rows of it, by the columns' own numbers
};

/// Sum of the products of two rows of equal lengths.
double dot(std::span<const double> a, std::span<const double> b);

} // namespace listric
