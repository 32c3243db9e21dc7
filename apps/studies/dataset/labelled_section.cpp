#include "apps/studies/dataset/labelled_section.hpp"

#include "apps/archive/folder/run_history.hpp"
#include "apps/archive/folder/setting.hpp"
#include "apps/figures/sections/seismic_section.hpp"
#include "apps/measures/faults/offset/fault_offset.hpp"
#include "apps/measures/strata/owner_map.hpp"
#include "apps/support/statistics.hpp"
#include "dem/base/place.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/random.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace listric {

using dem::Point;

namespace {

/// What is drawn for a section.
enum class DrawnFor : std::uint64_t { frequency, quality, noise, lateral, layer };

double drawn(const Drawn& ends, DrawnFor choice, std::uint64_t seed, std::size_t number) {
    return std::lerp(
        ends[0], ends[1],
        dem::uniform(seed, purposes::seismic_choice, number, static_cast<std::uint64_t>(choice)));
}

/// Numbers of ten binary places: what compresses well, and is exact enough for all that is noisy.
float rounded(double value) { return static_cast<float>(std::round(1024.0 * value) / 1024.0); }

/// Samples of a section that the data set's grid has, trace by trace; those beyond it are `none`.
template <class T>
std::vector<T> on_grid(const std::vector<T>& values, const SeismicSection& section,
                       const LabelledSection& grid, T none) {
    std::vector<T> all(grid.traces * grid.samples, none);
    for (std::size_t trace = 0; trace < std::min(grid.traces, section.traces); ++trace)
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(trace * section.samples),
                    std::min(grid.samples, section.samples),
                    all.begin() + static_cast<std::ptrdiff_t>(trace * grid.samples));
    return all;
}

/// A line of the section in traces and samples, with a point at every crossing of half a trace.
/// @param places  for each point of the result where it lies on the line: k + t
std::vector<Point> in_samples(std::span<const Point> line, const SeismicSection& section,
                              std::vector<double>& places) {
    std::vector<Point> all;
    const SeismicOptions& o = section.options;
    const auto add = [&](Point p, double place) {
        const double trace = (p.x - section.first_x) / o.trace_spacing;
        if (!(trace >= 0.0) || trace > static_cast<double>(section.traces - 1))
            return;
        const auto left = std::min(static_cast<std::size_t>(trace), section.traces - 2);
        all.push_back(
            {trace, std::lerp(section.sample_at(left, p.y), section.sample_at(left + 1, p.y),
                              trace - static_cast<double>(left))});
        places.push_back(place);
    };
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        const Point step = line[k + 1] - line[k];
        const int parts =
            1 + static_cast<int>(2.0 * dem::hypotenuse(step.x, step.y) / o.trace_spacing);
        for (int n = 0; n < parts; ++n) {
            const double t = static_cast<double>(n) / parts;
            add(line[k] + t * step, static_cast<double>(k) + t);
        }
    }
    if (!line.empty())
        add(line.back(), static_cast<double>(line.size() - 1));
    return all;
}

double value_at(std::span<const double> values, double place) {
    const auto k = std::min(static_cast<std::size_t>(place), values.size() - 1);
    return std::lerp(values[k], values[std::min(k + 1, values.size() - 1)],
                     place - static_cast<double>(k));
}

/// Marks a line; where lines cross the lower label stands.
/// @param offset  by point of the line
void mark(LabelledSection& labels, const SeismicSection& section, std::span<const Point> line,
          std::span<const double> offset, FaultLabel label, double width) {
    std::vector<double> places;
    const std::vector<Point> points = in_samples(line, section, places);
    for_samples_near(points, width, labels.traces, labels.samples,
                     [&](std::size_t trace, std::size_t sample, double place) {
                         const std::size_t at = trace * labels.samples + sample;
                         const auto number = static_cast<std::uint8_t>(label);
                         if (labels.fault[at] != 0 && labels.fault[at] <= number)
                             return;
                         labels.fault[at] = number;
                         if (!offset.empty())
                             labels.fault_throw[at] =
                                 rounded(value_at(offset, value_at(places, place)));
                     });
}

void mark_faults(LabelledSection& labels, const SeismicSection& section,
                 std::span<const measures::OffsetFault> faults, const DatasetSettings& s) {
    for (const measures::OffsetFault& fault : faults)
        for (const auto& [first, last] :
             visible_pieces(fault.points, fault.offset, s.least_throw, s.least_height)) {
            const std::size_t count = last - first + 1;
            const auto offset = std::span(fault.offset).subspan(first, count);
            std::vector<double> sizes;
            for (const double value : offset)
                sizes.push_back(std::abs(value));
            const double height = fault.points[first].y - fault.points[last].y;
            const bool is_certain = median(sizes) >= s.certain_throw && height >= s.certain_height;
            mark(labels, section, std::span(fault.points).subspan(first, count), offset,
                 !is_certain       ? FaultLabel::doubtful
                 : fault.is_active ? FaultLabel::active
                                   : FaultLabel::resting,
                 s.fault_width);
            ++(is_certain ? labels.faults : labels.doubtful);
            if (is_certain)
                labels.greatest_throw = std::max(labels.greatest_throw, std::ranges::max(sizes));
        }
}

/// The detachment, from trace to trace.
std::vector<Point> floor_of(const archive::RunFolder& run, const dem::State& state,
                            const SeismicSection& section) {
    const measures::RockSpace room(archive::make_setting(run.scene, run.parts), run.parts.base,
                                   state);
    std::vector<Point> line;
    for (std::size_t trace = 0; trace < section.traces; ++trace)
        line.push_back({section.x(trace), dem::height_at(room.floor, section.x(trace))});
    return line;
}

std::vector<float> reflectivity_of(const SeismicSection& section) {
    std::vector<float> sums(section.traces * section.samples, 0.0f);
    for (std::size_t trace = 0; trace < section.traces; ++trace)
        for (const measures::Reflection& r : section.rays[trace]) {
            const double k = std::round(section.sample_at(trace, section.top - r.depth));
            if (k >= 0.0 && k < static_cast<double>(section.samples))
                sums[trace * section.samples + static_cast<std::size_t>(k)] +=
                    static_cast<float>(r.coefficient);
        }
    for (float& sum : sums) // of coefficients of a thousandth and more
        sum = static_cast<float>(std::round(65536.0 * static_cast<double>(sum)) / 65536.0);
    return sums;
}

/// Puts noise on the image, and gives both their size.
void finish_image(LabelledSection& section, const std::vector<float>& noise, double share) {
    double sum = 0.0, count = 0.0;
    for (std::size_t at = 0; at < section.image.size(); ++at)
        if (section.layer[at] != SeismicSection::below_rock) {
            sum += static_cast<double>(section.image[at]) * static_cast<double>(section.image[at]);
            count += 1.0;
        }
    const double size = count > 0.0 && sum > 0.0 ? std::sqrt(sum / count) : 1.0;
    for (std::size_t at = 0; at < section.image.size(); ++at)
        section.image[at] = rounded(static_cast<double>(section.image[at]) / size +
                                    share * static_cast<double>(noise[at]));
    section.numbers.emplace_back("reflections_rms", size);
}

} // namespace

void for_samples_near(
    std::span<const Point> line, double width, std::size_t traces, std::size_t samples,
    const std::function<void(std::size_t trace, std::size_t sample, double place)>& mark) {
    const double reach = 0.5 * width;
    const auto range = [&](double a, double b, std::size_t size) {
        const double from = std::max(std::ceil(std::min(a, b) - reach), 0.0);
        const double to = std::floor(std::max(a, b) + reach);
        return std::pair(static_cast<std::size_t>(from),
                         to < 0.0 ? 0 : std::min(static_cast<std::size_t>(to) + 1, size));
    };
    for (std::size_t k = 0; k < line.size(); ++k) {
        const Point a = line[k], b = line[std::min(k + 1, line.size() - 1)], way = b - a;
        const double length = dem::dot(way, way);
        const auto [left, right] = range(a.x, b.x, traces);
        const auto [top, bottom] = range(a.y, b.y, samples);
        for (std::size_t trace = left; trace < right; ++trace)
            for (std::size_t sample = top; sample < bottom; ++sample) {
                const Point p{static_cast<double>(trace), static_cast<double>(sample)};
                const double t =
                    length > 0.0 ? std::clamp(dem::dot(p - a, way) / length, 0.0, 1.0) : 0.0;
                const Point away = p - (a + t * way);
                if (dem::dot(away, away) <= reach * reach)
                    mark(trace, sample, static_cast<double>(k) + t);
            }
    }
}

std::vector<std::pair<std::size_t, std::size_t>> visible_pieces(std::span<const Point> points,
                                                                std::span<const double> offset,
                                                                double least, double least_height) {
    std::vector<std::pair<std::size_t, std::size_t>> pieces;
    for (std::size_t k = 0; k < points.size();) {
        std::size_t end = k;
        while (end < points.size() && std::abs(offset[end]) >= least)
            ++end;
        if (end > k + 1 && std::abs(points[k].y - points[end - 1].y) >= least_height)
            pieces.emplace_back(k, end - 1);
        k = std::max(end, k + 1);
    }
    return pieces;
}

std::vector<float> seismic_noise(std::uint64_t seed, std::uint64_t number, std::size_t traces,
                                 std::size_t samples, double frequency) {
    const auto reach = static_cast<std::size_t>(std::ceil(1.2 / frequency));
    std::vector<double> wavelet;
    double square = 0.0;
    for (std::size_t k = 0; k <= 2 * reach; ++k) {
        wavelet.push_back(
            measures::ricker(static_cast<double>(k) - static_cast<double>(reach), frequency));
        square += wavelet.back() * wavelet.back();
    }
    // Sums of tens of these are as good as normally distributed.
    std::vector<float> single(traces * samples), noise(traces * samples);
    dem::for_each_shared(traces, [&](std::size_t trace) {
        std::vector<double> white;
        for (std::size_t k = 0; k < samples + 2 * reach; ++k)
            white.push_back(std::sqrt(12.0) *
                            (dem::uniform(seed, purposes::seismic_noise, number, trace, k) - 0.5));
        for (std::size_t k = 0; k < samples; ++k) {
            double sum = 0.0;
            for (std::size_t n = 0; n < wavelet.size(); ++n)
                sum += wavelet[n] * white[k + n];
            single[trace * samples + k] = static_cast<float>(sum / std::sqrt(square));
        }
    });
    // Migration makes noise of neighbouring traces alike: weights 1, 2, 1, for a square of 1.
    const float weight = static_cast<float>(1.0 / std::sqrt(6.0));
    for (std::size_t trace = 0; trace < traces; ++trace)
        for (std::size_t k = 0; k < samples; ++k) {
            const std::size_t before = trace > 0 ? trace - 1 : trace;
            const std::size_t after = std::min(trace + 1, traces - 1);
            noise[trace * samples + k] =
                weight * (single[before * samples + k] + 2.0f * single[trace * samples + k] +
                          single[after * samples + k]);
        }
    return noise;
}

LabelledSection labelled_section(const archive::RunFolder& run, const DatasetSettings& s,
                                 std::size_t number) {
    const std::uint64_t seed = run.scene.seed;
    const archive::Moment moment = run.read(run.snapshots.back());
    const Observation now{run.scene, run.parts, moment.state, moment.events};
    const measures::Setting setting = archive::make_setting(run.scene, run.parts);
    const archive::RunHistory history(run);
    const auto older = history.before(moment.state.clock.travel, setting);
    const auto faults =
        older.empty() ? std::vector<measures::OffsetFault>()
                      : measures::offset_faults(setting, moment.state, older.back(), s.least_throw);

    const double layer = drawn(s.layer, DrawnFor::layer, seed, number);
    const double noise = drawn(s.noise, DrawnFor::noise, seed, number);
    SeismicOptions options{.frequency = drawn(s.frequency, DrawnFor::frequency, seed, number),
                           .quality = drawn(s.quality, DrawnFor::quality, seed, number),
                           .lateral = drawn(s.lateral, DrawnFor::lateral, seed, number),
                           .in_depth = s.in_depth,
                           .trace_spacing = s.trace_spacing,
                           .sample_interval = s.in_depth ? s.depth_interval : s.sample_interval,
                           .has_labels = true,
                           .total_strain = true,
                           .pre_rift_layer = layer,
                           .contrast_seed =
                               dem::random_bits(seed, purposes::seismic_choice, number,
                                                std::numeric_limits<std::uint64_t>::max())};
    options.law.contrast = s.contrast;
    if (options.lateral < s.trace_spacing) // no wider than a trace
        options.lateral = 0.0;
    const SeismicSection section = seismic_section(now, {}, seismic_horizons(now, layer), options);

    LabelledSection labelled{.traces = static_cast<std::size_t>(s.traces),
                             .samples = static_cast<std::size_t>(s.samples)};
    labelled.image = on_grid(section.amplitude, section, labelled, 0.0f);
    labelled.layer = on_grid(section.layer, section, labelled, SeismicSection::below_rock);
    labelled.strain =
        on_grid(section.strain, section, labelled, std::numeric_limits<float>::quiet_NaN());
    for (float& strain : labelled.strain)
        strain = std::isnan(strain) ? std::numeric_limits<float>::quiet_NaN()
                                    : rounded(static_cast<double>(strain));
    labelled.reflectivity = on_grid(reflectivity_of(section), section, labelled, 0.0f);
    labelled.fault.assign(labelled.image.size(), 0);
    labelled.fault_throw.assign(labelled.image.size(), 0.0f);
    mark(labelled, section, floor_of(run, moment.state, section), {}, FaultLabel::detachment,
         s.fault_width);
    mark_faults(labelled, section, faults, s);
    const std::string unit = s.in_depth ? "m" : "s";
    labelled.numbers = {{"first_x_m", section.first_x},
                        {"trace_spacing_m", options.trace_spacing},
                        {"first_sample_" + unit, section.first_sample},
                        {"sample_interval_" + unit, options.sample_interval},
                        {"frequency_hz", options.frequency},
                        {"quality", options.quality},
                        {"noise", noise},
                        {"lateral_m", options.lateral},
                        {"layer_m", layer},
                        {"extension_m", moment.state.clock.extension.m}};
    constexpr double usual_velocity = 4500.0; // m/s, of noise by depth
    const double interval =
        s.in_depth ? 2.0 * s.depth_interval / usual_velocity : s.sample_interval;
    finish_image(labelled,
                 seismic_noise(seed, number, labelled.traces, labelled.samples,
                               options.frequency * interval),
                 noise);
    return labelled;
}

} // namespace listric
