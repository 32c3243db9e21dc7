#include "fluid/wet_sediment.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace listric::fluid {

using namespace dem;

namespace {

/// The stratum that ends the interval that holds a travel, or ends at it.
std::int32_t stratum_after(const Schedule& deposition, Travel travel) {
    constexpr double almost = 1e-2; // of an interval: a moment is a cycle early or late
    if (!std::isfinite(deposition.spacing()))
        return 0;
    const std::int64_t stratum = deposition.nearest(travel);
    const bool is_over = travel - deposition.due(stratum) > almost * deposition.gap(stratum + 1);
    return static_cast<std::int32_t>(is_over ? stratum + 1 : stratum);
}

/// Work at the surface in the interval that a stratum ends.
SurfaceWork work_at(const Motion& motion, const Schedule& deposition, std::int32_t stratum) {
    if (!std::isfinite(deposition.spacing()))
        return SurfaceWork::none;
    return motion.surface_work(deposition.due(stratum - 1), deposition.due(stratum));
}

} // namespace

WetGround::WetGround(const State& state, const Motion& motion, const WetSediment& sediment)
    : ground_(state),
      line_(sediment.surface.at(sediment.deposition.calendar().age(state.clock.travel))),
      next_(stratum_after(sediment.deposition, state.clock.travel)),
      work_(work_at(motion, sediment.deposition, next_)), left_free_(left_free * state.mean_radius),
      fresh_solid_(1.0 - sediment.pores_of(next_).surface_porosity) {}

double WetGround::pending(double x) const {
    const double height = line_.height(x) - left_free_ - ground_.height(x);
    switch (work_) {
    case SurfaceWork::both:
        return height;
    case SurfaceWork::fill:
        return std::max(0.0, height);
    case SurfaceWork::erode:
        return std::min(0.0, height);
    case SurfaceWork::none:
        break;
    }
    return 0.0;
}

double WetGround::grains(Point p, double of_discs) const {
    const double below_discs = ground_.depth(p), added = pending(p.x);
    if (below_discs <= 0.0)
        return fresh_solid_ * std::max(0.0, below_discs + added);
    if (added >= 0.0)
        return of_discs + fresh_solid_ * added;
    return of_discs * std::max(0.0, below_discs + added) / below_discs;
}

} // namespace listric::fluid
