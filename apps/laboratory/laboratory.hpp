#pragma once

#include "apps/laboratory/compression.hpp"
#include "apps/laboratory/sample.hpp"
#include "apps/laboratory/shear_box.hpp"
#include "apps/scene/material_file.hpp"
#include "apps/support/statistics.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// A call of the laboratory.
struct LaboratoryRequest {
    std::string test = {};             ///< uniaxial, biaxial, shear-box, pure-shear
    std::string material = {};         ///< name or path
    std::vector<std::string> set = {}; ///< "material.friction=1"
    std::int64_t discs = 1000;         ///< per sample
    std::int64_t seed = 1;             ///< of the first sample
    int seeds = 5;
    int threads = 1;
    std::filesystem::path output = {};        ///< empty: out/TEST-MATERIAL
    std::optional<std::string> reading;       ///< of strengths: stress, force
    std::string floaters = "grown";           ///< or left
    double speed = 1.0;                       ///< of the walls, over the default
    std::vector<double> stresses = {};        ///< confining or normal, MPa; empty: the default ones
    std::optional<std::string> vice;          ///< shear box: a material, elastic, or none
    std::optional<std::string> weakened;      ///< pure shear: what faults are made of
    std::string accuracy = "draft";           ///< pure shear: of the slab
    std::vector<double> weakening_rates = {}; ///< pure shear: critical, 1/s; empty: the default
    std::vector<double> healing_rates = {};   ///< ones
    bool quiet = false;
};

/// Calls work(k) for k = 0 .. count - 1, on several threads. The first exception in order of k is
/// thrown again.
void for_each_on_threads(std::size_t count, int threads,
                         const std::function<void(std::size_t)>& work);

/// The laboratory's work for one rock: several samples, the same test on each.
struct Laboratory {
    SampleParameters sample;
    std::uint64_t seed = 1;
    int seeds = 5;
    int threads = 1;
    double speed = 1.0; ///< of the walls, over the default
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

/// Tests samples of a material; prints a table and leaves CSV files, summary.json and a figure in
/// the output folder. Throws UsageError, SceneError, NumericalFailure, StorageError.
void run_laboratory(const LaboratoryRequest& request);

/// Throws UsageError if a sample or its seeds cannot be.
void check_sample(std::int64_t discs, std::int64_t seed, int seeds);

} // namespace listric
