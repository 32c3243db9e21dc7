#include "apps/measures/faults/bed_plane.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace listric::measures {

using namespace dem;

MarkMoments::MarkMoments(std::span<const Mark> marks) : count(static_cast<double>(marks.size())) {
    assert(!marks.empty());
    for (const Mark& mark : marks) {
        at = at + (1.0 / count) * mark.at;
        above += mark.above / count;
    }
    for (const Mark& mark : marks) {
        const Point r = mark.at - at;
        const double v = mark.above - above;
        xx += r.x * r.x;
        xy += r.x * r.y;
        yy += r.y * r.y;
        x_above += r.x * v;
        y_above += r.y * v;
        above_above += v * v;
    }
}

void MarkMoments::add_spread(const MarkMoments& other) {
    xx += other.xx;
    xy += other.xy;
    yy += other.yy;
    x_above += other.x_above;
    y_above += other.y_above;
}

std::optional<BedPlane> BedPlane::through(const MarkMoments& marks, const MarkMoments& spread) {
    constexpr double flattest = 1e-3; // the narrow spread over the wide one: two degrees
    const double determinant = spread.xx * spread.yy - spread.xy * spread.xy;
    const double all = spread.xx + spread.yy;
    if (!(determinant > flattest * all * all) || marks.count < 4.0)
        return std::nullopt;
    BedPlane plane;
    plane.at_ = marks.at;
    plane.above_ = marks.above;
    plane.count_ = marks.count;
    plane.slope_ = {(spread.x_above * spread.yy - spread.y_above * spread.xy) / determinant,
                    (spread.y_above * spread.xx - spread.x_above * spread.xy) / determinant};
    const Point s = plane.slope_;
    const double residual = marks.above_above - 2.0 * (s.x * marks.x_above + s.y * marks.y_above) +
                            s.x * s.x * marks.xx + 2.0 * s.x * s.y * marks.xy +
                            s.y * s.y * marks.yy;
    plane.variance_ = std::max(residual, 0.0) / (marks.count - 3.0);
    plane.xx_ = spread.xx;
    plane.xy_ = spread.xy;
    plane.yy_ = spread.yy;
    return plane;
}

double BedPlane::standard_error(Point p) const {
    const Point r = p - at_;
    const double determinant = xx_ * yy_ - xy_ * xy_;
    const double lever = (r.x * r.x * yy_ - 2.0 * r.x * r.y * xy_ + r.y * r.y * xx_) / determinant;
    return std::sqrt(variance_ * (1.0 / count_ + lever));
}

} // namespace listric::measures
