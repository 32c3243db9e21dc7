#include "fluid/sparse_solver.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

namespace listric::fluid {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

} // namespace

struct SparseSolver::Parts {
    Matrix matrix;                                   ///< lower triangle
    std::vector<std::size_t> diagonal, off_diagonal; ///< where in it the values are
    Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factors;
};

SparseSolver::SparseSolver(std::size_t unknowns, std::span<const MatrixEntry> entries)
    : parts_(std::make_unique<Parts>()) {
    const auto n = static_cast<Eigen::Index>(unknowns);
    std::vector<Eigen::Triplet<double>> triplets;
    const auto lower = [](MatrixEntry e) {
        assert(e.row != e.column);
        return std::pair(std::max(e.row, e.column), std::min(e.row, e.column));
    };
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(unknowns); ++k)
        triplets.emplace_back(k, k, 1.0);
    for (const MatrixEntry entry : entries)
        triplets.emplace_back(lower(entry).first, lower(entry).second, 0.0);
    Matrix& matrix = parts_->matrix;
    matrix.resize(n, n);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    const auto place_of = [&](std::int32_t row, std::int32_t column) {
        const auto* const rows = matrix.innerIndexPtr();
        const auto* const begin = rows + matrix.outerIndexPtr()[column];
        const auto* const end = rows + matrix.outerIndexPtr()[column + 1];
        return static_cast<std::size_t>(std::lower_bound(begin, end, row) - rows);
    };
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(unknowns); ++k)
        parts_->diagonal.push_back(place_of(k, k));
    for (const MatrixEntry entry : entries)
        parts_->off_diagonal.push_back(place_of(lower(entry).first, lower(entry).second));
    parts_->factors.analyzePattern(matrix);
}

SparseSolver::~SparseSolver() = default;

bool SparseSolver::factor(std::span<const double> diagonal, std::span<const double> off_diagonal) {
    assert(diagonal.size() == parts_->diagonal.size());
    assert(off_diagonal.size() == parts_->off_diagonal.size());
    double* const values = parts_->matrix.valuePtr();
    for (std::size_t k = 0; k < diagonal.size(); ++k)
        values[parts_->diagonal[k]] = diagonal[k];
    for (std::size_t k = 0; k < off_diagonal.size(); ++k)
        values[parts_->off_diagonal[k]] = off_diagonal[k];
    parts_->factors.factorize(parts_->matrix);
    return parts_->factors.info() == Eigen::Success;
}

void SparseSolver::solve(std::span<const double> right_side, std::span<double> solution) const {
    const auto n = static_cast<Eigen::Index>(right_side.size());
    const Eigen::VectorXd x =
        parts_->factors.solve(Eigen::Map<const Eigen::VectorXd>(right_side.data(), n));
    std::copy_n(x.data(), right_side.size(), solution.data());
}

} // namespace listric::fluid
