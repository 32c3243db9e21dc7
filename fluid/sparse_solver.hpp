#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace listric::fluid {

/// Place of an entry below the diagonal of a symmetric matrix, or above it.
struct MatrixEntry {
    std::int32_t row, column;
};

/// Direct solver for sparse symmetric positive definite matrices of one pattern. Equal input gives
/// equal bits on every processor.
class SparseSolver {
public:
    /// Orders the unknowns. @param entries  off the diagonal, each pair once
    SparseSolver(std::size_t unknowns, std::span<const MatrixEntry> entries);
    ~SparseSolver();
    SparseSolver(const SparseSolver&) = delete;
    SparseSolver& operator=(const SparseSolver&) = delete;

    /// Factors a matrix. False if it is not positive definite.
    /// @param off_diagonal  values of the entries
    bool factor(std::span<const double> diagonal, std::span<const double> off_diagonal);

    /// Solves with the matrix that was factored last.
    void solve(std::span<const double> right_side, std::span<double> solution) const;

    /// Factors a matrix and solves for one right side.
    bool solve(std::span<const double> diagonal, std::span<const double> off_diagonal,
               std::span<const double> right_side, std::span<double> solution) {
        if (!factor(diagonal, off_diagonal))
            return false;
        solve(right_side, solution);
        return true;
    }

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace listric::fluid
