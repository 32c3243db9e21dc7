#include "dem/ground_level.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace listric::dem {

GroundLevel::GroundLevel(const State& state) : width_(2.0 * state.mean_radius) {
    const ConstDiscColumns d = disc_columns(state);
    assert(!d.x.empty() && width_ > 0.0);
    const auto [left, right] = std::ranges::minmax(d.x);
    left_ = left;
    constexpr double nothing = -std::numeric_limits<double>::infinity();
    std::vector<double> top(static_cast<std::size_t>((right - left) / width_) + 1, nothing);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        double& t = top[static_cast<std::size_t>((d.x[i] - left) / width_)];
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
