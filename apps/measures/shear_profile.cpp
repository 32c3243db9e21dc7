#include "apps/measures/shear_profile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace listric::measures {

using namespace dem;

namespace {

/// Rows of the field's discs within `reach` on either side of p along n, and some beyond, that are
/// at most a band off that line.
std::vector<std::int32_t> discs_across(const ShearField& field, const Cells& cells, Point p,
                                       Point n, double reach, double band) {
    const Point t{n.y, -n.x};
    std::vector<std::int32_t> seen;
    // The cells are two bands wide.
    for (double s = -reach; s <= reach + band; s += 2.0 * band)
        cells.for_each_near(p.x + s * n.x, p.y + s * n.y, [&](std::int32_t row) {
            const auto k = static_cast<std::size_t>(row);
            if (std::abs(dot(Point{field.x[k], field.y[k]} - p, t)) <= band)
                seen.push_back(row);
        });
    std::ranges::sort(seen);
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    return seen;
}

/// Mean shear at 2 half + 1 places across a trace, one `step` apart; 0 where there is no disc.
std::vector<PlaneShear> mean_shear(const ShearField& field, const Cells& cells, Point p, Point t,
                                   double reach, double step, std::ptrdiff_t half) {
    const auto size = static_cast<std::size_t>(2 * half + 1);
    std::vector<double> weight(size, 0.0);
    std::vector<PlaneShear> mean(size);
    const double band = ShearProfile::band * field.diameter;
    const Point n{-t.y, t.x};
    for (std::int32_t row : discs_across(field, cells, p, n, reach, band)) {
        const auto k = static_cast<std::size_t>(row);
        const Point r = Point{field.x[k], field.y[k]} - p;
        const PlaneShear shear = field.components(k);
        const double place = dot(r, n) / step + static_cast<double>(half);
        // A triangle of 0.75 diameters to either side.
        const auto low = static_cast<std::ptrdiff_t>(std::ceil(place - 1.5));
        for (std::ptrdiff_t b = low; static_cast<double>(b) < place + 1.5; ++b) {
            if (b < 0 || b > 2 * half)
                continue;
            const double share = 1.0 - std::abs(static_cast<double>(b) - place) / 1.5;
            mean[static_cast<std::size_t>(b)].stretch += share * shear.stretch;
            mean[static_cast<std::size_t>(b)].turn += share * shear.turn;
            weight[static_cast<std::size_t>(b)] += share;
        }
    }
    for (std::size_t b = 0; b < size; ++b)
        if (weight[b] > 0.0)
            mean[b] = {mean[b].stretch / weight[b], mean[b].turn / weight[b]};
    return mean;
}

} // namespace

ShearProfile::ShearProfile(const ShearField& field, const Cells& cells, Point p, Point t,
                           double reach)
    : step_(0.5 * field.diameter), half_(static_cast<std::ptrdiff_t>(reach / step_)) {
    assert(half_ >= 3);
    const std::vector<PlaneShear> shear = mean_shear(field, cells, p, t, reach, step_, half_);
    for (const PlaneShear& s : shear)
        values_.push_back(s.along(t));
    for (std::ptrdiff_t b = -3; b <= 3; ++b)
        if (const double v = values_[static_cast<std::size_t>(half_ + b)];
            std::abs(v) > peak_value_) {
            peak_value_ = std::abs(v);
            sign_ = v < 0.0 ? -1.0 : 1.0;
            peak_ = half_ + b;
        }
    const double largest = shear[static_cast<std::size_t>(peak_)].size();
    alignment_ = largest > 0.0 ? peak_value_ / largest : 0.0;
}

double ShearProfile::slip() const {
    double sum = value(peak_);
    for (std::ptrdiff_t step : {1, -1})
        for (std::ptrdiff_t b = peak_ + step; b >= 0 && b <= 2 * half_; b += step) {
            const double v = value(b);
            if (v < 0.1 * peak_value_ || (v < 0.5 * peak_value_ && v > 1.1 * value(b - step)))
                break;
            sum += v;
        }
    return sign_ * sum * step_;
}

double ShearProfile::side(double share, std::ptrdiff_t step) const {
    const double level = share * peak_value_;
    for (std::ptrdiff_t b = peak_ + step; b >= 0 && b <= 2 * half_; b += step)
        if (const double v = value(b); v < level) {
            const double before = value(b - step);
            return static_cast<double>(std::abs(b - peak_)) - (level - v) / (before - v);
        }
    return static_cast<double>(step > 0 ? 2 * half_ - peak_ : peak_);
}

} // namespace listric::measures
