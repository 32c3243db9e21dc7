#pragma once

#include "apps/archive/folder/run_folder.hpp"
#include "apps/studies/dataset/dataset_plan.hpp"
#include "dem/numbers/point.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace listric {

/// Labels of the fault mask.
enum class FaultLabel : std::uint8_t {
    none,
    active,     ///< it slipped in the run's last window
    resting,    ///< it slipped before
    detachment, ///< below the hanging wall
    doubtful,   ///< rock is offset, and less than certain_throw
};

/// A seismic image with what is known at its samples, trace by trace.
struct LabelledSection {
    std::size_t traces = 0, samples = 0;
    std::vector<float> image = {};        ///< amplitude over that of the reflections alone, as rms
    std::vector<std::uint8_t> fault = {}; ///< a FaultLabel
    std::vector<float> fault_throw = {};  ///< vertical offset of rock at a marked fault, m; else 0
    std::vector<std::int16_t> layer = {}; ///< as of SeismicSection
    std::vector<float> strain = {};       ///< total shear strain; NaN outside rock
    std::vector<float> reflectivity = {}; ///< sum of reflection coefficients in a sample

    std::vector<std::pair<std::string, double>> numbers = {}; ///< how it was made, and its axes
    std::size_t faults = 0, doubtful = 0;                     ///< lines that are marked
    double greatest_throw = 0.0;                              ///< of faults, m
};

/// The section of a run's end. What is drawn by chance depends on the run's number and seed.
LabelledSection labelled_section(const archive::RunFolder& run, const DatasetSettings& settings,
                                 std::size_t number);

/// Calls mark(trace, sample, place) for every sample within half a width of a line, with the place
/// of its nearest point: k + t between points k and k + 1.
/// @param line  x: traces, y: samples, both from 0 on
void for_samples_near(
    std::span<const dem::Point> line, double width, std::size_t traces, std::size_t samples,
    const std::function<void(std::size_t trace, std::size_t sample, double place)>& mark);

/// First and last points of the pieces of a fault that are marked: a throw of `least` m at all of
/// them, and so many metres from their upper to their lower end.
std::vector<std::pair<std::size_t, std::size_t>> visible_pieces(std::span<const dem::Point> points,
                                                                std::span<const double> offset,
                                                                double least, double least_height);

/// Noise of the wavelet's frequencies, trace by trace, of a mean square of about 1.
/// @param frequency  of the wavelet, 1 over samples
std::vector<float> seismic_noise(std::uint64_t seed, std::uint64_t number, std::size_t traces,
                                 std::size_t samples, double frequency);

} // namespace listric
