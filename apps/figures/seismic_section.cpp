#include "apps/figures/seismic_section.hpp"

#include "apps/archive/setting.hpp"
#include "apps/figures/vocabulary.hpp"
#include "apps/figures/window_strain.hpp"
#include "apps/measures/owner_map.hpp"
#include "apps/measures/rock.hpp"
#include "dem/base/place.hpp"
#include "dem/hypotenuse.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace listric {

using namespace dem;
using namespace measures;

namespace {

/// Rock of every disc for a wave.
std::vector<SeismicRock> rock_of_discs(const Observation& now, const SeismicLaw& law) {
    const State& state = now.state;
    const ConstDiscColumns d = disc_columns(state);
    const std::vector<std::uint32_t> rock = rocks(state);
    const double layer = vocabulary().at("pre_rift").at("layer_m").get<double>();
    const bool compacts = state.discs.has("porosity");
    std::vector<SeismicRock> all;
    all.reserve(d.x.size());
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const bool is_sediment = d.stratum[i] > 0;
        const double start_depth = std::max(-d.start_y[i], 0.0);
        const double surface = now.parts.sediment ? now.parts.sediment->surface_porosity : 0.0;
        const double porosity =
            !is_sediment ? pre_rift_porosity * std::exp(-porosity_decay_per_m * start_depth)
            : compacts   ? state.discs.get<double>("porosity")[i]
                         : surface;
        SeismicRock& one = all.emplace_back(saturated_rock(law, porosity));
        const bool is_even = is_sediment ? d.stratum[i] % 2 == 0
                                         : std::fmod(std::floor(start_depth / layer), 2.0) == 0.0;
        one.velocity *= is_even ? 1.0 + law.contrast : 1.0 - law.contrast;
        if (rock[i] % 2 == 1) // rock_names: weak
            one.velocity *= law.weak_factor;
    }
    return all;
}

/// A column of the section from the datum down.
struct Ray {
    std::vector<SeismicLayer> layers; ///< the last one: the footwall
    std::vector<std::int32_t> owner;  ///< of each layer: disc, or of OwnerMap
};

class RaysOf {
public:
    RaysOf(const Observation& now, const SeismicLaw& law, double spacing)
        : room_(archive::make_setting(now.scene, now.parts), now.parts.base, now.state),
          map_(now.state, room_, spacing),
          rock_(rock_of_discs(now, law)), water_{law.fluid_velocity, law.fluid_density},
          footwall_(saturated_rock(law, 0.0)) {
        for (std::size_t at = 0; at < map_.owner.size(); ++at)
            if (map_.owner[at] >= 0)
                datum_ = std::max(datum_, map_.place(0, at / map_.columns).y + 0.5 * spacing);
    }

    double datum() const { return datum_; }
    const OwnerMap& map() const { return map_; }
    const Room& room() const { return room_; }

    Ray at(double x) const {
        const auto column =
            static_cast<std::size_t>(std::clamp(std::round((x - map_.corner.x) / map_.spacing), 0.0,
                                                static_cast<double>(map_.columns - 1)));
        const double floor = height_at(room_.floor, x);
        Ray ray;
        double top = datum_; // of what is not yet in a layer
        const auto add = [&](std::int32_t owner, double bottom) {
            if (bottom >= top)
                return;
            if (ray.owner.empty() || ray.owner.back() != owner) {
                ray.owner.push_back(owner);
                ray.layers.push_back({0.0, rock_for(owner)});
            }
            ray.layers.back().thickness += top - bottom;
            top = bottom;
        };
        for (std::size_t row = map_.rows; row-- > 0;) {
            const double bottom = std::max(map_.place(column, row).y - 0.5 * map_.spacing, floor);
            std::int32_t owner = map_.owner[row * map_.columns + column];
            if (owner == OwnerMap::outside) // a large pore goes on as what is above
                owner = ray.owner.empty() ? OwnerMap::air : ray.owner.back();
            add(owner, bottom);
        }
        add(OwnerMap::air, floor); // nothing at all is there
        ray.owner.push_back(OwnerMap::outside);
        ray.layers.push_back({0.0, footwall_});
        return ray;
    }

private:
    SeismicRock rock_for(std::int32_t owner) const {
        return owner >= 0 ? rock_[static_cast<std::size_t>(owner)] : water_;
    }

    Room room_;
    OwnerMap map_;
    std::vector<SeismicRock> rock_;
    SeismicRock water_, footwall_;
    double datum_ = 0.0;
};

/// Weighs traces with a normal distribution along x.
void blur(SeismicSection& section) {
    const double deviation = section.options.lateral / (2.0 * std::sqrt(2.0 * std::log(2.0))) /
                             section.options.trace_spacing; // traces
    const auto reach = static_cast<std::size_t>(std::ceil(3.0 * deviation));
    std::vector<double> weights;
    for (std::size_t k = 0; k <= reach; ++k) {
        const double place = static_cast<double>(k) / deviation;
        weights.push_back(std::exp(-0.5 * place * place));
    }
    const std::vector<float> sharp = section.amplitude;
    const std::size_t samples = section.samples;
    for_each_shared(section.traces, [&](std::size_t trace) {
        std::vector<double> sum(samples, 0.0);
        double all = 0.0;
        for (std::size_t near = trace - std::min(reach, trace);
             near <= std::min(trace + reach, section.traces - 1); ++near) {
            const double weight = weights[near > trace ? near - trace : trace - near];
            all += weight;
            for (std::size_t k = 0; k < samples; ++k)
                sum[k] += weight * static_cast<double>(sharp[near * samples + k]);
        }
        for (std::size_t k = 0; k < samples; ++k)
            section.amplitude[trace * samples + k] = static_cast<float>(sum[k] / all);
    });
}

/// Marks places of the owner map within a distance of faults, m.
std::vector<bool> near_faults(const OwnerMap& map, std::span<const Fault> faults, double distance) {
    std::vector<bool> near(map.owner.size(), false);
    for (const Fault& fault : faults)
        for (std::size_t k = 0; k + 1 < fault.trace.points.size(); ++k) {
            const Point a = fault.trace.points[k], b = fault.trace.points[k + 1];
            const double length = hypotenuse(b.x - a.x, b.y - a.y);
            const int steps = static_cast<int>(std::ceil(length / map.spacing)) + 1;
            for (int n = 0; n <= steps; ++n) {
                const double t = static_cast<double>(n) / steps;
                const Point p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
                const auto reach = static_cast<long>(std::ceil(distance / map.spacing));
                const long column = std::lround((p.x - map.corner.x) / map.spacing);
                const long row = std::lround((p.y - map.corner.y) / map.spacing);
                for (long i = std::max(column - reach, 0l);
                     i <= std::min(column + reach, static_cast<long>(map.columns) - 1); ++i)
                    for (long j = std::max(row - reach, 0l);
                         j <= std::min(row + reach, static_cast<long>(map.rows) - 1); ++j) {
                        const Point q =
                            map.place(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
                        if (hypotenuse(q.x - p.x, q.y - p.y) <= distance)
                            near[static_cast<std::size_t>(j) * map.columns +
                                 static_cast<std::size_t>(i)] = true;
                    }
            }
        }
    return near;
}

/// Depth below the datum of a two-way time, m.
double depth_at(std::span<const Reflection> boundaries, double time, double last) {
    const auto next =
        std::ranges::find_if(boundaries, [&](const Reflection& r) { return r.time >= time; });
    const double velocity = next == boundaries.end() ? last : next->velocity;
    const double from = next == boundaries.begin() ? 0.0 : (next - 1)->depth;
    const double since = next == boundaries.begin() ? 0.0 : (next - 1)->time;
    return from + 0.5 * velocity * (time - since);
}

} // namespace

SeismicSection seismic_section(const Observation& now, std::span<const Fault> faults,
                               const SeismicOptions& wanted) {
    SeismicSection section{.options = wanted};
    SeismicOptions& options = section.options;
    const double thickness = now.scene.hanging_wall.thickness;
    const RaysOf rays(now, options.law, std::max(0.25 * now.state.mean_radius, thickness / 1500.0));
    const OwnerMap& map = rays.map();
    section.datum = rays.datum();
    if (options.trace_spacing <= 0.0)
        options.trace_spacing = map.spacing;
    if (options.sample_interval <= 0.0)
        options.sample_interval =
            0.1 / options.frequency * (options.in_depth ? 0.5 * options.law.fluid_velocity : 1.0);
    section.first_x = std::max(rays.room().left, 0.0) + 0.5 * options.trace_spacing;
    section.traces = static_cast<std::size_t>(
        std::max((rays.room().right - section.first_x) / options.trace_spacing + 1.0, 1.0));
    std::vector<Ray> all(section.traces);
    std::vector<std::vector<Reflection>> boundaries(section.traces);
    for_each_shared(section.traces, [&](std::size_t k) {
        all[k] = rays.at(section.x(k));
        boundaries[k] = reflections(all[k].layers);
    });
    double end = 0.0;
    for (const auto& ray : boundaries)
        if (!ray.empty())
            end = std::max(end, options.in_depth ? ray.back().depth : ray.back().time);
    end += options.in_depth ? 500.0 : 3.0 / options.frequency;
    section.samples = static_cast<std::size_t>(std::ceil(end / options.sample_interval)) + 1;
    section.amplitude.assign(section.traces * section.samples, 0.0f);
    const double last = all.front().layers.back().rock.velocity;
    for_each_shared(section.traces, [&](std::size_t k) {
        const std::span<float> trace(section.amplitude.data() + k * section.samples,
                                     section.samples);
        if (options.in_depth)
            add_reflections_in_depth(trace, options.sample_interval, boundaries[k], last,
                                     options.frequency);
        else
            add_reflections(trace, options.sample_interval, boundaries[k], options.frequency);
    });
    if (options.lateral > 0.0)
        blur(section);
    if (!options.has_labels)
        return section;
    const std::vector<double> strain = window_strain(now);
    const std::vector<bool> near = near_faults(map, faults, 2.0 * now.state.mean_radius);
    section.strain.assign(section.amplitude.size(), std::numeric_limits<float>::quiet_NaN());
    section.fault.assign(section.amplitude.size(), 0);
    for (std::size_t trace = 0; trace < section.traces; ++trace) {
        const auto column = static_cast<std::size_t>(
            std::clamp(std::round((section.x(trace) - map.corner.x) / map.spacing), 0.0,
                       static_cast<double>(map.columns - 1)));
        for (std::size_t k = 0; k < section.samples; ++k) {
            const double depth = options.in_depth
                                     ? section.sample(k)
                                     : depth_at(boundaries[trace], section.sample(k), last);
            const double row = std::round((section.datum - depth - map.corner.y) / map.spacing);
            if (row < 0.0 || row >= static_cast<double>(map.rows))
                continue;
            const std::size_t at = static_cast<std::size_t>(row) * map.columns + column;
            if (map.owner[at] < 0)
                continue;
            section.strain[trace * section.samples + k] =
                static_cast<float>(strain[static_cast<std::size_t>(map.owner[at])]);
            section.fault[trace * section.samples + k] = near[at];
        }
    }
    return section;
}

bool has_seismics(const Scene& scene) { return scene.hanging_wall.thickness >= 1e3; }

} // namespace listric
