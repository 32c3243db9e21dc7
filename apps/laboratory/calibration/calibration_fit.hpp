#pragma once

#include "apps/laboratory/request.hpp"
#include "apps/laboratory/tests.hpp"
#include "apps/support/words/log.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace listric {

/// Measurements, each made once: what history.json holds is not measured again. The search is
/// deterministic, so a resumed one takes the same way.
class CalibrationHistory {
public:
    /// Throws StorageError if the file to resume from is no history.
    CalibrationHistory(std::filesystem::path file, bool resume);

    /// @param count  of the numbers that the work gives
    std::vector<double> measure(const std::string& what, const nlohmann::json& key,
                                std::size_t count,
                                const std::function<std::vector<double>()>& work);

    std::size_t size() const { return entries_.size(); }

    /// Measurements of other versions of the program, which are not used.
    std::size_t of_other_versions() const;

private:
    std::filesystem::path file_;
    nlohmann::json entries_ = nlohmann::json::array();
};

/// A calibration on its way: what is measured of trial rocks, and how far it is from the targets.
struct Calibration {
    static const std::vector<double> confining; ///< of the strengths, Pa
    static const std::vector<double> normal;    ///< of the bulk frictions, Pa

    const CalibrationTargets& targets;
    Laboratory lab;
    CalibrationHistory history;
    Log& log;
    std::vector<std::string> misses = {}; ///< targets that were not reached, and why

    struct PlaneStrain {
        double young, poisson; ///< Pa, 1
    };
    /// Means over the samples.
    PlaneStrain elastic(const RockMaterial& rock);

    /// Peak axial stress, Pa, at the confining stresses.
    std::vector<double> strength(const RockMaterial& rock);

    /// Bulk friction over strain 0.1 to 0.3 at the normal stresses, between elastic blocks.
    std::vector<double> bulk_friction(const RockMaterial& weak, const RockMaterial& vice);

    /// Wanted peak axial stress at a confining stress, Pa.
    double target_axial(double stress) const;
};

/// Stiffness and stiffness ratio: E grows in proportion to k_n; nu with log(k_n/k_s), found by
/// secants.
void fit_stiffness(Calibration& calibration, RockMaterial& rock);

/// Disc friction and tensile strength for the envelope, by Gauss-Newton on the relative errors of
/// the peaks.
void fit_strength(Calibration& calibration, RockMaterial& rock);

/// Friction of the weakened discs, by secants. Softer than the rock they shear in a narrow zone; of
/// 85 times the largest normal stress, as mat18-w-calibrated has, their bulk friction hardly
/// depends on it.
RockMaterial fit_weak(Calibration& calibration, const RockMaterial& rock, const std::string& name,
                      double target);

} // namespace listric
