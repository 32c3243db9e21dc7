// Synthetic seismics against what is known of the convolution model: times of flat layers, size
// and sign of reflections, and the thickness at which a layer is tuned (Kallweit & Wood 1982).

#include "apps/measures/strata/seismic_trace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace listric::seismic_test {

using namespace measures;
namespace {

constexpr double frequency = 25.0; // Hz

/// Samples of a trace of so many seconds.
std::vector<float> trace_of(const std::vector<SeismicLayer>& layers, double interval,
                            double seconds) {
    std::vector<float> trace(static_cast<std::size_t>(seconds / interval));
    add_reflections(trace, interval, reflections(layers), {frequency});
    return trace;
}

/// Layers of rock of rising and falling impedance.
std::vector<SeismicLayer> flat_layers() {
    const double thickness[] = {400.0, 650.0, 300.0, 900.0, 500.0};
    const double porosity[] = {0.45, 0.30, 0.38, 0.15, 0.05};
    std::vector<SeismicLayer> layers;
    for (std::size_t k = 0; k < std::size(thickness); ++k)
        layers.push_back({thickness[k], saturated_rock({}, porosity[k])});
    layers.push_back({0.0, saturated_rock({}, 0.0)});
    return layers;
}

TEST(Seismic, VelocityIsTheTimeAverageOfMatrixAndFluid) {
    const SeismicLaw law;
    EXPECT_DOUBLE_EQ(saturated_rock(law, 0.0).velocity, law.matrix_velocity);
    EXPECT_DOUBLE_EQ(saturated_rock(law, 1.0).velocity, law.fluid_velocity);
    // 1/(0.7/5500 + 0.3/1500), and 0.7 * 2650 + 0.3 * 1000.
    EXPECT_NEAR(saturated_rock(law, 0.3).velocity, 3055.6, 0.1);
    EXPECT_NEAR(saturated_rock(law, 0.3).density, 2155.0, 1e-9);
}

// Fast, slow and cracked ground at the same depth below the datum is at the same time.
TEST(Seismic, WhatIsAboveTheGroundShiftsNoTrace) {
    for (const double porosity : {0.0, 0.2, 0.5}) {
        std::vector<SeismicLayer> layers{{100.0, saturated_rock({}, porosity)}};
        layers.push_back({0.0, saturated_rock({}, 0.1)});
        cover(layers, 750.0, 2400.0);
        const std::vector<Reflection> all = reflections(layers);
        ASSERT_EQ(all.size(), 2u);
        EXPECT_DOUBLE_EQ(all[0].time, 2.0 * 750.0 / 2400.0);
        EXPECT_NEAR(all[0].coefficient, 0.0, 1e-15);
    }
}

TEST(Seismic, FlatLayersReflectAtTheirTimesWithinASample) {
    constexpr double interval = 0.002;
    const std::vector<SeismicLayer> layers = flat_layers();
    const std::vector<float> trace = trace_of(layers, interval, 4.0);
    double time = 0.0;
    for (std::size_t k = 0; k + 1 < layers.size(); ++k) {
        time += 2.0 * layers[k].thickness / layers[k].rock.velocity;
        // The largest sample within half a period of it; neighbours are further apart.
        const double half = 0.5 * ricker_period(frequency);
        std::size_t peak = 0;
        for (std::size_t n = 0; n < trace.size(); ++n)
            if (std::abs(static_cast<double>(n) * interval - time) < half &&
                (peak == 0 || std::abs(trace[n]) > std::abs(trace[peak])))
                peak = n;
        EXPECT_NEAR(static_cast<double>(peak) * interval, time, interval) << k;
        const double above = layers[k].rock.impedance(), below = layers[k + 1].rock.impedance();
        // A wavelet that is sampled a sample beside its peak has lost 4 % of it.
        EXPECT_NEAR(static_cast<double>(trace[peak]), (below - above) / (below + above),
                    0.04 * std::abs(below - above) / (below + above))
            << k;
    }
}

TEST(Seismic, InDepthFlatLayersReflectAtTheirDepthsWithinASample) {
    constexpr double interval = 5.0;
    const std::vector<SeismicLayer> layers = flat_layers();
    std::vector<float> trace(700);
    add_reflections_in_depth(trace, interval, reflections(layers), layers.back().rock.velocity,
                             {frequency});
    double depth = 0.0;
    for (std::size_t k = 0; k + 1 < layers.size(); ++k) {
        depth += layers[k].thickness;
        std::size_t peak = 0;
        for (std::size_t n = 0; n < trace.size(); ++n)
            if (std::abs(static_cast<double>(n) * interval - depth) < 25.0 &&
                (peak == 0 || std::abs(trace[n]) > std::abs(trace[peak])))
                peak = n;
        EXPECT_NEAR(static_cast<double>(peak) * interval, depth, interval) << k;
    }
}

TEST(Seismic, AWedgeIsTunedAtAQuarterWavelength) {
    const SeismicRock shale = saturated_rock({}, 0.30), sand = saturated_rock({}, 0.20);
    const double wavelength = sand.velocity * ricker_period(frequency);
    double tuned = 0.0, largest = 0.0, thick = 0.0;
    for (double thickness = 2.0; thickness < 0.9 * wavelength; thickness += 0.5) {
        const auto trace = trace_of({{500.0, shale}, {thickness, sand}, {0.0, shale}}, 2e-4, 0.6);
        thick = 0.0;
        for (const float value : trace)
            thick = std::max(thick, static_cast<double>(std::abs(value)));
        if (thick > largest) {
            largest = thick;
            tuned = thickness;
        }
    }
    EXPECT_NEAR(tuned, 0.25 * wavelength, 0.05 * 0.25 * wavelength);
    // Two reflections of unlike sign are stronger than one by the wavelet's troughs, 2 exp(-3/2).
    EXPECT_NEAR(largest / thick, 1.0 + 2.0 * std::exp(-1.5), 0.02);
}

TEST(Seismic, NoContrastNoReflection) {
    const SeismicRock rock = saturated_rock({}, 0.2);
    for (const float value : trace_of({{300.0, rock}, {200.0, rock}, {0.0, rock}}, 0.002, 1.0))
        EXPECT_EQ(value, 0.0f);
}

// The highest place of f^2 exp(-f^2 / f0^2 - pi f t / Q), sought in steps of a hundredth of a
// hertz.
TEST(Seismic, LossStretchesTheWaveletAsItsSpectrumSays) {
    const Wavelet wavelet{30.0, 80.0};
    EXPECT_DOUBLE_EQ(wavelet.frequency_at(0.0), 30.0);
    EXPECT_DOUBLE_EQ((Wavelet{30.0, 0.0}.frequency_at(2.0)), 30.0);
    for (const double time : {0.5, 1.5, 3.0}) {
        double best = 0.0, highest = 0.0;
        for (double f = 5.0; f < 40.0; f += 0.01) {
            const double size =
                f * f * std::exp(-f * f / 900.0 - 3.14159265358979 * f * time / 80.0);
            if (size > highest) {
                highest = size;
                best = f;
            }
        }
        EXPECT_NEAR(wavelet.frequency_at(time), best, 0.02) << time;
    }
}

} // namespace
} // namespace listric::seismic_test
