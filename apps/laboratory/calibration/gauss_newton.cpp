#include "apps/laboratory/calibration/gauss_newton.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace listric {

namespace {

using Errors = std::vector<double>;
using Jacobian = std::array<Errors, 2>; ///< by parameter

double root_mean_square(const Errors& errors) {
    double square = 0.0;
    for (double one : errors)
        square += one * one;
    return std::sqrt(square / static_cast<double>(errors.size()));
}

Jacobian by_differences(const GaussNewton& problem, const TwoParameters& x, const Errors& e) {
    Jacobian jacobian;
    for (std::size_t p = 0; p < 2; ++p) {
        TwoParameters moved = x;
        moved[p] += problem.difference[p];
        const Errors there = problem.errors(moved);
        assert(there.size() == e.size());
        jacobian[p].resize(e.size());
        for (std::size_t k = 0; k < e.size(); ++k)
            jacobian[p][k] = (there[k] - e[k]) / problem.difference[p];
    }
    return jacobian;
}

/// Solves the normal equations.
TwoParameters step(const Jacobian& jacobian, const Errors& e) {
    double a = 1e-4, b = 0.0, d = 1e-4, u = 0.0, v = 0.0; // damped by the diagonal's first values
    for (std::size_t k = 0; k < e.size(); ++k) {
        a += jacobian[0][k] * jacobian[0][k];
        b += jacobian[0][k] * jacobian[1][k];
        d += jacobian[1][k] * jacobian[1][k];
        u -= jacobian[0][k] * e[k];
        v -= jacobian[1][k] * e[k];
    }
    const double determinant = a * d - b * b;
    return {(d * u - b * v) / determinant, (a * v - b * u) / determinant};
}

/// Broyden's: the least change that explains the errors after a move of this squared length.
void update(Jacobian& jacobian, const Errors& before, const Errors& after,
            const TwoParameters& move, double length) {
    for (std::size_t k = 0; k < before.size(); ++k) {
        const double predicted = before[k] + jacobian[0][k] * move[0] + jacobian[1][k] * move[1];
        for (std::size_t p = 0; p < 2; ++p)
            jacobian[p][k] += (after[k] - predicted) * move[p] / length;
    }
}

} // namespace

TwoParameters GaussNewton::minimise(const TwoParameters& start) const {
    TwoParameters x = start, best = start;
    Errors e = errors(x);
    assert(!e.empty());
    Jacobian jacobian = by_differences(*this, x, e);
    double least = root_mean_square(e);
    for (int round = 0; round < rounds && least > enough; ++round) {
        const TwoParameters wish = step(jacobian, e);
        TwoParameters next, move;
        for (std::size_t p = 0; p < 2; ++p) {
            const double limited = std::clamp(wish[p], -longest[p], longest[p]);
            next[p] = std::clamp(x[p] + limited, lower[p], upper[p]);
            move[p] = next[p] - x[p];
        }
        const double length = move[0] * move[0] + move[1] * move[1];
        if (length < shortest * shortest)
            break;
        const Errors there = errors(next);
        update(jacobian, e, there, move, length);
        x = next;
        e = there;
        if (root_mean_square(e) < least) {
            least = root_mean_square(e);
            best = x;
        }
    }
    return best;
}

} // namespace listric
