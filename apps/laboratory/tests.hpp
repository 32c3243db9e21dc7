#pragma once

#include "apps/laboratory/compression.hpp"
#include "apps/laboratory/sample.hpp"
#include "apps/laboratory/shear_box.hpp"
#include "apps/scene/parameters/material_file.hpp"
#include "apps/support/machine/stop.hpp"

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace listric {

/// The laboratory's work for one rock: several samples, the same test on each, on several threads.
/// All that works throws NumericalFailure, and Interrupted if a stop is requested.
struct Laboratory {
    SampleParameters sample;
    std::uint64_t seed = 1; ///< of the first sample
    int seeds = 5;
    int threads = 1;
    double speed = 1.0; ///< of the walls, over the default
    StopToken stop;
    std::function<void(std::string_view, std::size_t, std::size_t)> report =
        [](std::string_view, std::size_t, std::size_t) {}; ///< stage, done, of how many

    std::vector<Specimen> make_samples(const dem::Material& material) const;

    /// Stress-strain curves of samples with unbreakable bonds, by seed.
    std::vector<std::vector<CompressionPoint>> uniaxial(const RockMaterial& rock,
                                                        const std::vector<Specimen>& samples) const;

    /// Curves at confining stresses, Pa: by stress, then seed.
    std::vector<std::vector<std::vector<CompressionPoint>>>
    biaxial(const RockMaterial& rock, const std::vector<Specimen>& samples,
            const std::vector<double>& confining) const;

    /// Tests at normal stresses, Pa: by stress, then seed.
    std::vector<std::vector<ShearTest>> shear_box(const ShearBoxFilling& filling,
                                                  const std::vector<Specimen>& samples,
                                                  const std::vector<double>& normal) const;
};

/// Sample of a compression test, 2,000 m x 4,000 m [paper].
SampleParameters compression_sample(std::size_t discs);

/// Sample of the shear box: 2,000 m high, of discs of the paper's size, as long as they fill.
SampleParameters shear_box_sample(std::size_t discs);

/// Throws UsageError if a sample or its seeds cannot be.
void check_sample(std::int64_t discs, std::int64_t seed, int seeds);

} // namespace listric
