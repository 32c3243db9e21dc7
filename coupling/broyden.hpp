#pragma once

#include <span>
#include <vector>

namespace listric::coupling {

/// Broyden's method for r(x) = 0 in n unknowns: Newton's with an inverse Jacobian that is learned
/// from the residuals themselves (Broyden 1965, the good update).
class Broyden {
public:
    /// @param inverse  first approximation of (-dr/dx)^-1, n by n by rows
    explicit Broyden(std::vector<double> inverse);

    std::size_t unknowns() const { return unknowns_; }

    /// By how much to change x where the residual is this.
    std::vector<double> step(std::span<const double> residual) const;

    /// Learns that this step changed the residual by so much: the least change of the approximation
    /// that agrees.
    void update(std::span<const double> step, std::span<const double> residual_change);

    /// Returns to the first approximation.
    void restart() { inverse_ = first_inverse_; }

private:
    std::vector<double> first_inverse_, inverse_;
    std::size_t unknowns_;
};

} // namespace listric::coupling
