#pragma once

#include <array>
#include <functional>
#include <vector>

namespace listric {

using TwoParameters = std::array<double, 2>;

/// Two parameters for which a vector of errors shall be least.
struct GaussNewton {
    std::function<std::vector<double>(const TwoParameters&)> errors; ///< dear; of one length always
    TwoParameters lower, upper;                                      ///< where the search stays
    TwoParameters difference; ///< steps of the first Jacobian's differences
    TwoParameters longest;    ///< moves of one round, at most
    int rounds = 6;
    double enough = 0.0;   ///< root mean square of the errors at which the search ends
    double shortest = 0.0; ///< move at which it ends

    /// The best point met on the way from `start`: Gauss-Newton, barely damped, with Broyden's
    /// update of the Jacobian after one by differences.
    TwoParameters minimise(const TwoParameters& start) const;
};

} // namespace listric
