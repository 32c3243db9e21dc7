#include "apps/measures/strata/seismic_trace.hpp"

#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace listric::measures {

namespace {

/// Half length of Ricker's wavelet in its period: beyond it is below 1e-6.
constexpr double reach_in_periods = 2.0;

} // namespace

SeismicRock saturated_rock(const SeismicLaw& law, double porosity) {
    return {1.0 / ((1.0 - porosity) / law.matrix_velocity + porosity / law.fluid_velocity),
            (1.0 - porosity) * law.grain_density + porosity * law.fluid_density};
}

void cover(std::vector<SeismicLayer>& layers, double thickness, double velocity) {
    assert(!layers.empty() && velocity > 0.0);
    layers.insert(layers.begin(),
                  {thickness, {velocity, layers.front().rock.impedance() / velocity}});
}

std::vector<Reflection> reflections(std::span<const SeismicLayer> layers) {
    std::vector<Reflection> all;
    double depth = 0.0, time = 0.0;
    for (std::size_t k = 0; k + 1 < layers.size(); ++k) {
        depth += layers[k].thickness;
        time += 2.0 * layers[k].thickness / layers[k].rock.velocity;
        const double above = layers[k].rock.impedance(), below = layers[k + 1].rock.impedance();
        all.push_back({depth, time, (below - above) / (below + above), layers[k].rock.velocity});
    }
    return all;
}

double ricker(double time, double frequency) {
    const double a = dem::pi * frequency * time;
    return (1.0 - 2.0 * a * a) * dem::exponential(-a * a);
}

double ricker_period(double frequency) { return std::sqrt(6.0) / (dem::pi * frequency); }

double Wavelet::frequency_at(double time) const {
    if (!(quality > 0.0))
        return frequency;
    // The highest place of f^2 exp(-f^2 / f0^2 - pi f t / Q).
    const double loss = 0.25 * dem::pi * std::max(time, 0.0) / quality;
    return frequency * frequency * (std::sqrt(loss * loss + 1.0 / (frequency * frequency)) - loss);
}

void add_reflections(std::span<float> trace, double interval,
                     std::span<const Reflection> reflections, const Wavelet& wavelet,
                     double start) {
    assert(interval > 0.0 && wavelet.frequency > 0.0);
    const auto last = static_cast<double>(trace.size()) - 1.0;
    for (const Reflection& r : reflections) {
        const double frequency = wavelet.frequency_at(r.time), time = r.time - start;
        const double reach = reach_in_periods * ricker_period(frequency);
        const double from = std::max(std::ceil((time - reach) / interval), 0.0);
        const double to = std::min(std::floor((time + reach) / interval), last);
        for (double sample = from; sample <= to; sample += 1.0)
            trace[static_cast<std::size_t>(sample)] +=
                static_cast<float>(r.coefficient * ricker(sample * interval - time, frequency));
    }
}

double time_at(std::span<const Reflection> reflections, double depth, double last) {
    const auto next =
        std::ranges::find_if(reflections, [&](const Reflection& r) { return r.depth >= depth; });
    const double velocity = next == reflections.end() ? last : next->velocity;
    const double from = next == reflections.begin() ? 0.0 : (next - 1)->depth;
    const double since = next == reflections.begin() ? 0.0 : (next - 1)->time;
    return since + 2.0 * (depth - from) / velocity;
}

void add_reflections_in_depth(std::span<float> trace, double interval,
                              std::span<const Reflection> reflections, double last,
                              const Wavelet& wavelet) {
    assert(interval > 0.0 && wavelet.frequency > 0.0);
    // The latest wavelet is the longest.
    const double reach =
        reach_in_periods *
        ricker_period(wavelet.frequency_at(reflections.empty() ? 0.0 : reflections.back().time));
    std::size_t first = 0; // reflection within reach of the sample
    for (std::size_t k = 0; k < trace.size(); ++k) {
        const double time = time_at(reflections, interval * static_cast<double>(k), last);
        while (first < reflections.size() && reflections[first].time < time - reach)
            ++first;
        double sum = 0.0;
        for (std::size_t n = first; n < reflections.size() && reflections[n].time <= time + reach;
             ++n)
            sum += reflections[n].coefficient *
                   ricker(time - reflections[n].time, wavelet.frequency_at(reflections[n].time));
        trace[k] += static_cast<float>(sum);
    }
}

} // namespace listric::measures
