#pragma once

#include <functional>
#include <optional>
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

/// What is found at a place.
struct Trial {
    std::vector<double> residual;
    double error = 0.0; ///< by which trials are compared
    bool is_good = false;
};

/// Tries places from x on, each a step of Broyden's method from the one before, until one is good.
/// What was learned is forgotten every eighth time, for residuals that kink. After 24 trials the
/// place with the least error is tried again, as the last. Returns the number of trials; none if no
/// place was good or an error was infinite or NaN.
/// @param x  the start; the last place that was tried on return
std::optional<int>
find_root(Broyden& broyden, std::vector<double>& x,
          const std::function<Trial(std::span<const double> place, bool is_last)>& attempt);

} // namespace listric::coupling
