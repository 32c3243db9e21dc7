#include "dem/base/ground_level.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace listric::dem {

GroundLevel::GroundLevel(const State& state, double least_age) : width_(2.0 * state.mean_radius) {
    const ConstDiscColumns d = disc_columns(state);
    const auto counts = [&](std::size_t i) {
        return d.stratum[i] == 0 || state.clock.travel.m - d.start_travel[i] >= least_age;
    };
    left_ = std::numeric_limits<double>::infinity();
    double right = -left_;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (counts(i)) {
            left_ = std::min(left_, d.x[i]);
            right = std::max(right, d.x[i]);
        }
    assert(left_ <= right && width_ > 0.0);
    constexpr double nothing = -std::numeric_limits<double>::infinity();
    std::vector<double> top(static_cast<std::size_t>((right - left_) / width_) + 1, nothing);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (counts(i)) {
            double& t = top[static_cast<std::size_t>((d.x[i] - left_) / width_)];
            t = std::max(t, d.y[i] + d.radius[i]);
        }
    heights_.resize(top.size());
    constexpr std::size_t reach = 2; // columns to either side
    for (std::size_t k = 0; k < top.size(); ++k) {
        double sum = 0.0;
        int count = 0;
        for (std::size_t m = k - std::min(k, reach); m < std::min(k + reach + 1, top.size()); ++m)
            if (top[m] > nothing) {
                sum += top[m];
                ++count;
            }
        // Where no disc is near, the ground goes on as it was.
        heights_[k] = count > 0 ? sum / count : heights_[k - 1];
    }
}

double GroundLevel::height(double x) const {
    const double last = static_cast<double>(heights_.size() - 1);
    const double place = std::clamp((x - left_) / width_ - 0.5, 0.0, last);
    const auto k = std::min(static_cast<std::size_t>(place), heights_.size() - 1);
    const double after = heights_[std::min(k + 1, heights_.size() - 1)];
    return heights_[k] + (place - static_cast<double>(k)) * (after - heights_[k]);
}

} // namespace listric::dem
