#include "apps/figures/sections/seismic_section.hpp"

#include "apps/archive/folder/setting.hpp"
#include "apps/figures/vocabulary.hpp"
#include "apps/figures/window_strain.hpp"
#include "apps/measures/strata/owner_map.hpp"
#include "apps/measures/strata/rock.hpp"
#include "dem/base/place.hpp"
#include "dem/columns.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace listric {

using namespace dem;
using namespace measures;

namespace {

/// Mean of neighbours within `reach` places along rows or columns of a map, in place.
void average(std::vector<double>& values, std::size_t lines, std::size_t line_step,
             std::size_t length, std::size_t step, std::size_t reach) {
    for_each_shared(lines, [&](std::size_t line) {
        std::vector<double> sums{0.0};
        for (std::size_t k = 0; k < length; ++k)
            sums.push_back(sums.back() + values[line * line_step + k * step]);
        for (std::size_t k = 0; k < length; ++k) {
            const std::size_t from = k - std::min(reach, k), to = std::min(k + reach + 1, length);
            values[line * line_step + k * step] =
                (sums[to] - sums[from]) / static_cast<double>(2 * reach + 1);
        }
    });
}

/// Porosity of sediment at every place of a map: of its discs, as a mean over a disc's
/// surroundings. 0 where there is none near.
std::vector<double> sediment_porosity(const Observation& now, const OwnerMap& map) {
    const State& state = now.state;
    const ConstDiscColumns d = disc_columns(state);
    std::vector<double> weight(map.owner.size(), 0.0), sum(map.owner.size(), 0.0);
    std::vector<double> porosity(d.x.size(),
                                 now.parts.sediment ? now.parts.sediment->surface_porosity : 0.0);
    if (state.discs.has(dem::columns::porosity))
        std::ranges::copy(state.discs.get(dem::columns::porosity), porosity.begin());
    for (std::size_t at = 0; at < map.owner.size(); ++at)
        if (map.owner[at] >= 0) {
            const auto i = static_cast<std::size_t>(map.owner[at]);
            if (d.stratum[i] > 0) {
                weight[at] = 1.0;
                sum[at] = porosity[i];
            }
        }
    const auto reach = static_cast<std::size_t>(std::lround(2.0 * state.mean_radius / map.spacing));
    for (std::vector<double>* values : {&weight, &sum})
        for (int twice = 0; twice < 2; ++twice) {
            average(*values, map.rows, map.columns, map.columns, 1, reach);
            average(*values, map.columns, 1, map.rows, map.columns, reach);
        }
    for (std::size_t at = 0; at < sum.size(); ++at)
        sum[at] = weight[at] > 1e-6 ? sum[at] / weight[at] : 0.0;
    return sum;
}

/// Highest place of lines at x, m; none if they are not there.
std::optional<double> height_of(std::span<const Polyline> lines, double x) {
    std::optional<double> highest;
    for (const Polyline& line : lines)
        for (std::size_t k = 0; k + 1 < line.size(); ++k) {
            const Point a = line[k], b = line[k + 1];
            if ((a.x - x) * (b.x - x) > 0.0 || a.x == b.x)
                continue;
            const double y = std::lerp(a.y, b.y, (x - a.x) / (b.x - a.x));
            highest = std::max(highest.value_or(y), y);
        }
    return highest;
}

/// Thickness of layers of pre-rift rock, m.
double pre_rift_layer(double wanted) {
    return wanted > 0.0 ? wanted : vocabulary().at("pre_rift").at("layer_m").get<double>();
}

/// Columns of the section from the top down, as layers of rock.
class Rays {
public:
    Rays(const Observation& now, std::span<const Horizon> horizons, const SeismicOptions& options,
         double spacing)
        : law_(options.law), contrast_seed_(options.contrast_seed),
          horizons_(horizons.begin(), horizons.end()),
          room_(archive::make_setting(now.scene, now.parts), now.parts.base, now.state),
          map_(now.state, room_, spacing), porosity_(sediment_porosity(now, map_)),
          rock_(rocks(now.state)), layer_(pre_rift_layer(options.pre_rift_layer)),
          ground_porosity_(now.parts.sediment ? now.parts.sediment->surface_porosity
                                              : pre_rift_porosity) {
        std::ranges::sort(horizons_, {}, &Horizon::stratum);
        for (const Horizon& horizon : horizons_)
            for (const Polyline& line : horizon.top)
                for (const Point p : line)
                    top_ = std::max(top_, p.y);
        top_ = std::ceil(top_); // of which a file's header has whole metres
    }

    double top() const { return top_; }
    const OwnerMap& map() const { return map_; }
    const RockSpace& room() const { return room_; }

    /// The last layer is the footwall, without end.
    std::vector<SeismicLayer> at(double x) const {
        const double floor = height_at(room_.floor, x);
        std::vector<SeismicLayer> layers;
        const std::vector<double> tops = tops_at(x);
        const double surface = tops.empty() ? floor : tops.back();
        const std::size_t column = column_of(x);
        double top = surface;
        bool is_weak = false;
        for (std::size_t n = horizons_.size(); n-- > 0;) {
            const double bottom = n > 0 ? tops[n - 1] : floor;
            while (bottom < top) {
                const std::size_t row = row_of(top - 1e-6 * map_.spacing);
                // The cell's lower edge, or the horizon.
                const double cell = map_.place(column, row).y - 0.5 * map_.spacing;
                const double edge = std::max(bottom, std::min(cell, top - 1e-3 * map_.spacing));
                const std::size_t place = row * map_.columns + column;
                if (map_.owner[place] >= 0)
                    is_weak = rock_[static_cast<std::size_t>(map_.owner[place])] % 2 == 1;
                add(layers, top - edge, rock_at(horizons_[n].stratum, porosity_[place], is_weak));
                top = edge;
            }
        }
        layers.push_back({0.0, saturated_rock(law_, 0.0)});
        cover(layers, top_ - surface, saturated_rock(law_, ground_porosity_).velocity);
        return layers;
    }

    /// Numbers of the layers at heights of a column; of air that of the topmost.
    template <class Height>
    void layers_at(double x, std::span<std::int16_t> numbers, Height&& height) const {
        const std::vector<double> tops = tops_at(x);
        const double floor = height_at(room_.floor, x);
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const double y = height(k);
            std::size_t n = 0;
            while (n + 1 < tops.size() && tops[n] < y)
                ++n;
            numbers[k] = y < floor || tops.empty()
                             ? SeismicSection::below_rock
                             : static_cast<std::int16_t>(horizons_[n].stratum);
        }
    }

    /// y of the topmost rock.
    double ground(double x) const {
        const std::vector<double> tops = tops_at(x);
        return tops.empty() ? height_at(room_.floor, x) : tops.back();
    }

    std::size_t column_of(double x) const {
        return static_cast<std::size_t>(std::clamp(std::round((x - map_.corner.x) / map_.spacing),
                                                   0.0, static_cast<double>(map_.columns - 1)));
    }
    std::size_t row_of(double y) const {
        return static_cast<std::size_t>(std::clamp(std::round((y - map_.corner.y) / map_.spacing),
                                                   0.0, static_cast<double>(map_.rows - 1)));
    }

private:
    /// Tops of horizons, each at least as high as the one below.
    std::vector<double> tops_at(double x) const {
        const double floor = height_at(room_.floor, x);
        std::vector<double> tops;
        for (const Horizon& horizon : horizons_)
            tops.push_back(std::max(height_of(horizon.top, x).value_or(floor),
                                    tops.empty() ? floor : tops.back()));
        return tops;
    }

    SeismicRock rock_at(int stratum, double porosity, bool is_weak) const {
        const double depth = (0.5 - stratum) * layer_; // of pre-rift rock, at the start
        SeismicRock rock =
            saturated_rock(law_, stratum > 0 ? porosity
                                             : pre_rift_porosity *
                                                   dem::exponential(-porosity_decay_per_m * depth));
        rock.velocity *= 1.0 + law_.contrast * contrast_of(stratum);
        if (is_weak)
            rock.velocity *= law_.weak_factor;
        return rock;
    }

    /// In units of the law's.
    double contrast_of(int stratum) const {
        constexpr double most = 2.5; // standard deviations
        if (!contrast_seed_)
            return stratum % 2 == 0 ? 1.0 : -1.0;
        return std::clamp(dem::normal(*contrast_seed_, purposes::seismic_contrast,
                                      static_cast<std::uint64_t>(stratum)),
                          -most, most);
    }

    /// Rock that hardly differs from the layer above belongs to it: gradients become steps that
    /// reflect a thousandth.
    static void add(std::vector<SeismicLayer>& layers, double thickness, SeismicRock rock) {
        constexpr double hardly = 2e-3;
        if (layers.empty() ||
            std::abs(layers.back().rock.impedance() / rock.impedance() - 1.0) > hardly)
            layers.push_back({0.0, rock});
        layers.back().thickness += thickness;
    }

    SeismicLaw law_;
    std::optional<std::uint64_t> contrast_seed_;
    std::vector<Horizon> horizons_; ///< oldest first
    RockSpace room_;
    OwnerMap map_;
    std::vector<double> porosity_;
    std::vector<std::uint32_t> rock_;
    double layer_; ///< thickness of the layers of pre-rift rock, m
    double ground_porosity_;
    double top_ = 0.0;
};

/// Weighs traces with a normal distribution along x.
void blur(SeismicSection& section) {
    const double deviation = section.options.lateral /
                             (2.0 * std::sqrt(2.0 * dem::logarithm(2.0))) /
                             section.options.trace_spacing; // traces
    const auto reach = static_cast<std::size_t>(std::ceil(3.0 * deviation));
    std::vector<double> weights;
    for (std::size_t k = 0; k <= reach; ++k) {
        const double place = static_cast<double>(k) / deviation;
        weights.push_back(dem::exponential(-0.5 * place * place));
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

/// Depth below the top of a two-way time from there, m.
double depth_at(std::span<const Reflection> boundaries, double time, double last) {
    const auto next =
        std::ranges::find_if(boundaries, [&](const Reflection& r) { return r.time >= time; });
    const double velocity = next == boundaries.end() ? last : next->velocity;
    const double from = next == boundaries.begin() ? 0.0 : (next - 1)->depth;
    const double since = next == boundaries.begin() ? 0.0 : (next - 1)->time;
    return from + 0.5 * velocity * (time - since);
}

/// An interval with a whole number of a unit, such as micro for 1e6, in which a file's header has
/// it.
double whole(double interval, double per_unit) {
    return std::max(std::round(per_unit * interval), 1.0) / per_unit;
}

/// What is known at every sample: strain of the last window, faults and layers.
void add_labels(SeismicSection& section, const Observation& now, const Rays& rays,
                std::span<const Fault> faults) {
    const OwnerMap& map = rays.map();
    const std::vector<double> strain =
        section.options.total_strain ? total_strain(now) : window_strain(now);
    const std::vector<bool> near = near_faults(map, faults, 2.0 * now.state.mean_radius);
    section.strain.assign(section.amplitude.size(), std::numeric_limits<float>::quiet_NaN());
    section.fault.assign(section.amplitude.size(), 0);
    section.layer.assign(section.amplitude.size(), SeismicSection::below_rock);
    for (std::size_t trace = 0; trace < section.traces; ++trace) {
        const std::size_t column = rays.column_of(section.x(trace));
        rays.layers_at(section.x(trace),
                       std::span(section.layer).subspan(trace * section.samples, section.samples),
                       [&](std::size_t k) { return section.height(trace, k); });
        for (std::size_t k = 0; k < section.samples; ++k) {
            const double row = std::round((section.height(trace, k) - map.corner.y) / map.spacing);
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
}

/// First sample and number of samples, by the highest rock and the last reflection.
void measure_traces(SeismicSection& section) {
    const SeismicOptions& options = section.options;
    double rise = 0.0; // of the topmost rock above the original surface, s
    for (std::size_t k = 0; k < section.traces; ++k)
        rise = std::max(rise,
                        section.zero[k] - time_at(section.rays[k], section.top - section.ground[k],
                                                  section.last_velocity));
    section.first_sample = 0.0 - (options.in_depth ? section.top : 1e-3 * std::ceil(1e3 * rise));
    double end = 0.0;
    for (std::size_t k = 0; k < section.traces; ++k)
        if (const auto& ray = section.rays[k]; !ray.empty())
            end = std::max(end, options.in_depth ? ray.back().depth - section.top
                                                 : ray.back().time - section.zero[k]);
    end += (options.in_depth ? 500.0 : 3.0 / options.frequency) - section.first_sample;
    section.samples = static_cast<std::size_t>(std::ceil(end / options.sample_interval)) + 1;
}

} // namespace

double SeismicSection::height(std::size_t trace, std::size_t k) const {
    return options.in_depth ? 0.0 - sample(k)
                            : top - depth_at(rays[trace], sample(k) + zero[trace], last_velocity);
}

double SeismicSection::sample_at(std::size_t trace, double y) const {
    const double place =
        options.in_depth ? -y : time_at(rays[trace], top - y, last_velocity) - zero[trace];
    return (place - first_sample) / options.sample_interval;
}

SeismicSection seismic_section(const Observation& now, std::span<const Fault> faults,
                               std::span<const Horizon> horizons, const SeismicOptions& wanted) {
    SeismicSection section{.options = wanted};
    SeismicOptions& options = section.options;
    const double thickness = now.scene.hanging_wall.thickness;
    const Rays rays(now, horizons, options,
                    std::max(0.25 * now.state.mean_radius, thickness / 1500.0));
    section.top = rays.top();
    if (options.trace_spacing <= 0.0)
        options.trace_spacing = rays.map().spacing;
    if (options.sample_interval <= 0.0)
        options.sample_interval = whole(
            0.1 / options.frequency * (options.in_depth ? 0.5 * options.law.fluid_velocity : 1.0),
            options.in_depth ? 1e3 : 1e6);
    section.first_x = std::max(rays.room().left, 0.0) + 0.5 * options.trace_spacing;
    section.traces = static_cast<std::size_t>(
        std::max((rays.room().right - section.first_x) / options.trace_spacing + 1.0, 1.0));
    section.rays.resize(section.traces);
    for_each_shared(section.traces,
                    [&](std::size_t k) { section.rays[k] = reflections(rays.at(section.x(k))); });
    section.last_velocity = saturated_rock(options.law, 0.0).velocity;
    for (std::size_t k = 0; k < section.traces; ++k) {
        section.ground.push_back(rays.ground(section.x(k)));
        section.zero.push_back(time_at(section.rays[k], section.top, section.last_velocity));
    }
    measure_traces(section);
    section.amplitude.assign(section.traces * section.samples, 0.0f);
    const Wavelet wavelet{options.frequency, options.quality};
    for_each_shared(section.traces, [&](std::size_t k) {
        const std::span<float> trace(section.amplitude.data() + k * section.samples,
                                     section.samples);
        if (options.in_depth)
            add_reflections_in_depth(trace, options.sample_interval, section.rays[k],
                                     section.last_velocity, wavelet);
        else
            add_reflections(trace, options.sample_interval, section.rays[k], wavelet,
                            section.zero[k] + section.first_sample);
    });
    if (options.lateral > 0.0)
        blur(section);
    if (options.has_labels)
        add_labels(section, now, rays, faults);
    return section;
}

std::vector<Horizon> seismic_horizons(const Observation& now, double wanted) {
    Setting setting = archive::make_setting(now.scene, now.parts);
    setting.boundaries.clear(); // rock's velocity is by its depth at the start, whatever its layer
    return trace_horizons(setting, now.parts.base, now.state, {}, {pre_rift_layer(wanted)});
}

std::vector<Horizon> seismic_horizons(const Observation& now, std::vector<Horizon> traced) {
    return now.parts.layers.empty() ? std::move(traced) : seismic_horizons(now);
}

bool has_seismics(const Scene& scene) { return scene.hanging_wall.thickness >= 1e3; }

} // namespace listric
