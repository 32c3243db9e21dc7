#include "apps/measures/strata/predicted_horizons.hpp"

#include "apps/measures/basin/kinematics.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>

namespace listric::measures {

using namespace dem;

namespace {

/// Thickness of the grains from the ground to a depth, m.
double grains_above_depth(const PorosityByDepth& porosity, double depth) {
    if (porosity.decay <= 0.0)
        return depth * (1.0 - porosity.surface);
    return depth -
           porosity.surface / porosity.decay * (1.0 - dem::exponential(-porosity.decay * depth));
}

/// Depth to which so much grain reaches, m: Newton's method, from above, where it converges.
double depth_of_grains(const PorosityByDepth& porosity, double grains) {
    double depth = grains / (1.0 - porosity.surface);
    for (int round = 0; round < 50; ++round) {
        const double step = (grains_above_depth(porosity, depth) - grains) /
                            (1.0 - porosity.surface * dem::exponential(-porosity.decay * depth));
        depth -= step;
        if (std::abs(step) < 1e-6 * (1.0 + depth))
            break;
    }
    return depth;
}

/// Heights of a sheared top by the shear coordinate u = x + depth tan(angle), which ascends.
class HeightsByShear {
public:
    HeightsByShear(const Polyline& top, double tangent) {
        for (const Point p : top) {
            u_.push_back(p.x - p.y * tangent);
            y_.push_back(p.y);
        }
    }

    double at(double u) const {
        const auto next = std::ranges::lower_bound(u_, u);
        if (next == u_.begin())
            return y_.front();
        if (next == u_.end())
            return y_.back();
        const auto k = static_cast<std::size_t>(next - u_.begin());
        return std::lerp(y_[k - 1], y_[k], (u - u_[k - 1]) / (u_[k] - u_[k - 1]));
    }

private:
    std::vector<double> u_, y_;
};

} // namespace

Polyline predicted_horizon(const Chain& detachment, double extension, double since, double angle,
                           double right, const PorosityByDepth& porosity) {
    Polyline horizon = inclined_shear_top(detachment, since, angle, right);
    if (since >= extension || porosity.decay <= 0.0 || porosity.surface <= 0.0)
        return horizon;
    const double tangent = dem::tangent(angle * pi / 180.0);
    const Polyline pre_rift = inclined_shear_top(detachment, extension, angle, right);
    if (pre_rift.empty())
        return horizon;
    const HeightsByShear floor(pre_rift, tangent);
    for (Point& p : horizon) {
        const double u = p.x - p.y * tangent;
        if (u < extension) // on the detachment there is no older sediment below
            continue;
        const double depth = -floor.at(u), below = depth + p.y; // below it as deposited
        if (depth <= 0.0 || below <= 0.0)
            continue;
        p.y = -depth_of_grains(porosity, std::max(0.0, grains_above_depth(porosity, depth) -
                                                           grains_above_depth(porosity, below)));
        p.x = u + p.y * tangent;
    }
    return horizon;
}

std::vector<double> depths_at(const Polyline& line, std::span<const double> x) {
    Polyline sorted = line;
    std::ranges::stable_sort(sorted, {}, &Point::x);
    std::vector<double> depths;
    for (const double at : x) {
        const auto next = std::ranges::lower_bound(sorted, at, {}, &Point::x);
        if (sorted.empty())
            depths.push_back(0.0);
        else if (next == sorted.begin())
            depths.push_back(-sorted.front().y);
        else if (next == sorted.end())
            depths.push_back(-sorted.back().y);
        else {
            const Point a = *std::prev(next), b = *next;
            depths.push_back(-(b.x > a.x ? std::lerp(a.y, b.y, (at - a.x) / (b.x - a.x)) : b.y));
        }
    }
    return depths;
}

} // namespace listric::measures
