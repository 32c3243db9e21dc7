#include "apps/measures/faults/shear_profile.hpp"

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

} // namespace

void ShearProfile::Place::add(const Place& disc, double share) {
    weight += share;
    shear.stretch += share * disc.shear.stretch;
    shear.turn += share * disc.shear.turn;
    across += share * disc.across;
    moved = moved + share * disc.moved;
    turn += share * disc.turn;
}

void ShearProfile::Place::divide() {
    if (weight == 0.0)
        return;
    for (double* sum : {&shear.stretch, &shear.turn, &across, &moved.x, &moved.y, &turn})
        *sum /= weight;
}

ShearProfile::Place ShearProfile::place_of(const ShearField& field, std::size_t k, Point p,
                                           Point t) {
    const Point n{-t.y, t.x};
    return {.shear = field.components(k),
            .across = dot(Point{field.x[k], field.y[k]} - p, n),
            .moved = {field.dx[k], field.dy[k]},
            .turn = n.x * (field.xx[k] * t.x + field.xy[k] * t.y) +
                    n.y * (field.yx[k] * t.x + field.yy[k] * t.y)};
}

ShearProfile::ShearProfile(const ShearField& field, const Cells& cells, Point p, Point t,
                           double reach)
    : step_(0.5 * field.diameter), half_(static_cast<std::ptrdiff_t>(reach / step_)) {
    assert(half_ >= 3);
    places_.resize(static_cast<std::size_t>(2 * half_ + 1)); // one step apart
    const Point n{-t.y, t.x};
    for (std::int32_t row : discs_across(field, cells, p, n, reach, band * field.diameter)) {
        const Place disc = place_of(field, static_cast<std::size_t>(row), p, t);
        const double place = disc.across / step_ + static_cast<double>(half_);
        // A triangle of 0.75 diameters to either side.
        const auto low = static_cast<std::ptrdiff_t>(std::ceil(place - 1.5));
        for (std::ptrdiff_t b = low; static_cast<double>(b) < place + 1.5; ++b)
            if (b >= 0 && b <= 2 * half_)
                places_[static_cast<std::size_t>(b)].add(
                    disc, 1.0 - std::abs(static_cast<double>(b) - place) / 1.5);
    }
    for (Place& mean : places_) {
        mean.divide();
        values_.push_back(mean.shear.along(t));
    }
    for (std::ptrdiff_t b = -3; b <= 3; ++b)
        if (const double v = values_[static_cast<std::size_t>(half_ + b)];
            std::abs(v) > peak_value_) {
            peak_value_ = std::abs(v);
            sign_ = v < 0.0 ? -1.0 : 1.0;
            peak_ = half_ + b;
        }
    const double largest = places_[static_cast<std::size_t>(peak_)].shear.size();
    alignment_ = largest > 0.0 ? peak_value_ / largest : 0.0;
}

std::size_t ShearProfile::end(std::ptrdiff_t step) const {
    std::ptrdiff_t end = peak_;
    for (std::ptrdiff_t b = peak_ + step; b >= 0 && b <= 2 * half_; b += step) {
        const double v = value(b);
        if (v < 0.5 * peak_value_ && v > 1.1 * value(b - step))
            break;
        if (places_[static_cast<std::size_t>(b)].weight > 0.0)
            end = b;
        if (v < 0.1 * peak_value_ && end == b)
            break;
    }
    return static_cast<std::size_t>(end);
}

double ShearProfile::slip(Point direction) const {
    if (peak_value_ == 0.0)
        return 0.0;
    const std::size_t left = end(1), right = end(-1);
    double turn = 0.0, weight = 0.0;
    for (std::size_t b = right; b <= left; ++b) {
        turn += places_[b].weight * places_[b].turn;
        weight += places_[b].weight;
    }
    return dot(places_[left].moved - places_[right].moved, direction) +
           (places_[left].across - places_[right].across) * turn / weight;
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
