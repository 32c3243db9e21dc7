#include "dem/base/sediment_film.hpp"

#include "dem/base/place.hpp"

#include <algorithm>

namespace listric::dem {

double FilmNow::thickness(double x, double ground) const {
    return x >= left && x <= right ? std::clamp(target.height(x) - ground, 0.0, most) : 0.0;
}

TargetLine SedimentFilm::target_at(Travel travel) const {
    return target.at(deposition.calendar().age(travel));
}

std::optional<FilmNow> SedimentFilm::now(const State& state, const RigidBase& base) const {
    const Travel travel = state.clock.travel;
    const SurfaceWork work = base.motion.surface_work(travel, travel);
    if (work != SurfaceWork::both && work != SurfaceWork::fill)
        return std::nullopt;
    const auto stratum = static_cast<std::int32_t>(deposition.nearest(travel));
    const Chain& chain = base.surfaces.front().chain;
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    return FilmNow{target_at(travel), 2.0 * state.mean_radius,
                   nodes.x.empty() ? chain.front().start.x : nodes.x.front() + nodes.ux.front(),
                   wall_x + wall_way(base, state.clock.extension.m),
                   beds.law(stratum, {.surface_porosity = surface_porosity}).surface_porosity};
}

} // namespace listric::dem
