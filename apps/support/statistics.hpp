#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace listric {

/// Mean and standard deviation of a sample.
struct Spread {
    double mean = 0.0, deviation = 0.0;
};

/// Spread of at least one value; the deviation of a single one is 0.
inline Spread spread(std::span<const double> values) {
    assert(!values.empty());
    const auto n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double square = 0.0;
    for (double v : values)
        square += (v - mean) * (v - mean);
    return {mean, values.size() > 1 ? std::sqrt(square / (n - 1.0)) : 0.0};
}

/// Median of at least one value; of an even number the larger of the two in the middle.
inline double median(std::vector<double> values) {
    assert(!values.empty());
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// Limits of a probability, each by itself at a confidence of 95 %.
struct ProbabilityLimits {
    double lower = 0.0, upper = 1.0;
};

/// Limits of the probability that a try succeeds, of which `met` of `of` did: exact (Clopper and
/// Pearson, Biometrika 26, 1934). Below the lower one as many successes or more have a probability
/// under 5 %, above the upper one as many or fewer. No try: 0 and 1.
ProbabilityLimits probability_limits(int met, int of);

/// Slope of the least-squares line y(x), of at least two different x.
inline double least_squares_slope(std::span<const double> x, std::span<const double> y) {
    assert(x.size() == y.size() && x.size() > 1);
    const auto n = static_cast<double>(x.size());
    const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
    const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
    double square = 0.0, product = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        square += (x[k] - mean_x) * (x[k] - mean_x);
        product += (x[k] - mean_x) * (y[k] - mean_y);
    }
    return product / square;
}

} // namespace listric
