#include "coupling/broyden.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace listric::coupling {

Broyden::Broyden(std::vector<double> inverse)
    : first_inverse_(std::move(inverse)), inverse_(first_inverse_),
      unknowns_(
          static_cast<std::size_t>(std::llround(std::sqrt(static_cast<double>(inverse_.size()))))) {
    assert(unknowns_ * unknowns_ == inverse_.size());
}

std::vector<double> Broyden::step(std::span<const double> residual) const {
    assert(residual.size() == unknowns_);
    std::vector<double> result(unknowns_, 0.0);
    for (std::size_t i = 0; i < unknowns_; ++i)
        for (std::size_t k = 0; k < unknowns_; ++k)
            result[i] += inverse_[i * unknowns_ + k] * residual[k];
    return result;
}

void Broyden::update(std::span<const double> step, std::span<const double> residual_change) {
    assert(step.size() == unknowns_ && residual_change.size() == unknowns_);
    const std::size_t n = unknowns_;
    // With H the approximation, s the step and y the change: H -= (s + H y) (s^T H) / (s^T H y).
    std::vector<double> correction = this->step(residual_change), step_row(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k)
            step_row[k] += inverse_[i * n + k] * step[i];
    const double scale =
        std::inner_product(correction.begin(), correction.end(), step.begin(), 0.0);
    if (scale == 0.0)
        return;
    for (std::size_t i = 0; i < n; ++i) {
        correction[i] += step[i];
        for (std::size_t k = 0; k < n; ++k)
            inverse_[i * n + k] -= correction[i] * step_row[k] / scale;
    }
}

namespace {

constexpr int most_trials = 24; // and one more at the best place
constexpr int restart_every = 8;

std::vector<double> difference(std::vector<double> a, std::span<const double> b) {
    std::ranges::transform(a, b, a.begin(), std::minus());
    return a;
}

} // namespace

std::optional<int> find_root(Broyden& broyden, std::vector<double>& x,
                             const std::function<Trial(std::span<const double>, bool)>& attempt) {
    std::vector<double> best = x, x_before, residual_before;
    double least_error = std::numeric_limits<double>::infinity();
    for (int trials = 1;; ++trials) {
        const bool is_last = trials > most_trials;
        const Trial trial = attempt(x, is_last);
        if (trials > 1) // from where x was, which is not always a step of the method
            broyden.update(difference(x, x_before), difference(trial.residual, residual_before));
        if (trials % restart_every == 0)
            broyden.restart();
        if (trial.is_good)
            return trials;
        if (is_last || !std::isfinite(trial.error))
            return std::nullopt;
        if (trials < most_trials && trial.error < least_error) {
            least_error = trial.error;
            best = x;
        }
        x_before = x;
        residual_before = trial.residual;
        if (trials == most_trials)
            x = best;
        else
            std::ranges::transform(x, broyden.step(trial.residual), x.begin(), std::plus());
    }
}

} // namespace listric::coupling
