#include "apps/measures/strata/line_misfit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace listric::measures {

using namespace dem;

std::optional<LineMisfit> misfit(std::span<const Point> points, std::span<const Polyline> pieces,
                                 double margin) {
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (const Polyline& piece : pieces)
        for (const Point p : piece) {
            left = std::min(left, p.x);
            right = std::max(right, p.x);
        }
    LineMisfit found;
    for (const Point p : points) {
        if (p.x < left - margin || p.x > right + margin)
            continue;
        double nearest = std::numeric_limits<double>::infinity();
        for (const Polyline& piece : pieces)
            nearest = std::min(nearest, piece.size() < 2 ? norm(p - piece.front())
                                                         : std::abs(place_on(piece, p).distance));
        ++found.compared;
        found.mean += nearest;
        if (nearest >= found.largest) {
            found.largest = nearest;
            found.worst = p;
        }
    }
    if (found.compared == 0)
        return std::nullopt;
    found.mean /= static_cast<double>(found.compared);
    return found;
}

} // namespace listric::measures
