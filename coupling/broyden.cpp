#include "coupling/broyden.hpp"

#include <cassert>
#include <cmath>
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

} // namespace listric::coupling
