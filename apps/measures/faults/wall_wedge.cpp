#include "apps/measures/faults/wall_wedge.hpp"

#include "apps/measures/polyline.hpp"
#include "dem/columns.hpp"

#include <algorithm>
#include <cstddef>

namespace listric::measures {

using namespace dem;

namespace {

constexpr std::size_t layers = 8, fewest = 4;

bool base_rests(const Motion& motion) {
    if (motion.stages.empty())
        return motion.runs_from == runs_nowhere;
    return std::ranges::all_of(
        motion.stages, [](const MotionStage& stage) { return stage.runs_from == runs_nowhere; });
}

std::optional<double> border_dip(const Setting& setting, const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    struct Layer {
        std::vector<double> places; ///< at the start, m
        std::size_t gone = 0;       ///< discs that the wall has taken along
    };
    std::vector<Layer> all(layers);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double share = -d.start_y[i] / setting.thickness;
        if (d.stratum[i] != 0 || share < 0.0 || share >= 1.0)
            continue;
        Layer& layer = all[static_cast<std::size_t>(share * layers)];
        layer.places.push_back(d.start_x[i]);
        layer.gone += (d.x[i] - d.start_x[i]) / state.clock.extension.m >= 0.5;
    }
    Polyline border;
    for (std::size_t k = 0; k < layers; ++k) {
        auto& [places, gone] = all[k];
        if (gone == 0 || gone >= places.size())
            continue;
        // The border is where as many discs are nearer to the wall as have gone with it.
        std::ranges::sort(places);
        const std::size_t first = places.size() - gone;
        border.push_back({0.5 * (places[first - 1] + places[first]),
                          -(static_cast<double>(k) + 0.5) * setting.thickness / layers});
    }
    return border.size() >= fewest ? std::optional(dip_of(border)) : std::nullopt;
}

std::optional<double> slope_from_wall(const Profile& profile, double diameter) {
    const auto& top = profile.pre_rift_top;
    const auto [low, high] = std::ranges::minmax_element(top);
    const double height = *high - *low;
    if (height < 4.0 * diameter)
        return std::nullopt;
    Polyline slope;
    for (auto k = static_cast<std::size_t>(high - top.begin()); k > 0; --k) {
        const double share = (top[k] - *low) / height;
        if (share < 1.0 / 6.0)
            break;
        if (share <= 5.0 / 6.0)
            slope.push_back({profile.x[k], top[k]});
    }
    return slope.size() >= fewest ? std::optional(dip_of(slope)) : std::nullopt;
}

} // namespace

WallWedge measure_wall_wedge(const Setting& setting, const State& state, const Profile& profile) {
    const double extension = state.clock.extension.m;
    if (!setting.has_detachment || extension == 0.0 || !base_rests(setting.motion))
        return {};
    return {border_dip(setting, state),
            extension < 0.0 ? slope_from_wall(profile, 2.0 * state.mean_radius) : std::nullopt};
}

} // namespace listric::measures
