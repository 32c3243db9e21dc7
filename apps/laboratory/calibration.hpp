#pragma once

#include "apps/support/machine/stop.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace listric {

/// Targets of a rock.
struct CalibrationTargets {
    double young = 50e9;    ///< plane strain, Pa
    double poisson = 0.25;  ///< plane strain
    double friction = 0.6;  ///< slope of the strength envelope in shear over normal stress
    double cohesion = 10e6; ///< Pa
    bool byerlee = false;   ///< Byerlee's law instead of friction and cohesion
    std::optional<double> bulk_friction; ///< of the weakened rock in the shear box

    /// Throws UsageError if no discs can be such a rock.
    void check() const;
};

/// A call of the calibration.
struct CalibrationRequest {
    CalibrationTargets targets = {};
    std::string name = "calibrated"; ///< of the material files
    std::int64_t discs = 1000;       ///< per sample
    std::int64_t seed = 1;           ///< of the first sample used for the fit
    int seeds = 3;                   ///< for the fit, and as many others for the validation
    int threads = 1;
    bool resume = false;
    std::filesystem::path output = {}; ///< empty: out/calibrate-NAME
    bool quiet = false;
    StopToken stop = {};
};

/// Finds microproperties in the paper's sequence: stiffness, stiffness ratio, strengths, weakened
/// rock. Writes NAME.toml (and NAME-weak.toml), history.json with every evaluation, which --resume
/// reads back, and summary.json with the validation on seeds that the fit has not seen.
/// Throws UsageError, NumericalFailure, StorageError, Interrupted: what was measured is kept.
void run_calibration(const CalibrationRequest& request);

} // namespace listric
