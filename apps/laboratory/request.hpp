#pragma once

#include "apps/archive/folder/json_file.hpp"
#include "apps/support/machine/stop.hpp"

#include <cstdint>
#include <filesystem>
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
    StopToken stop = {};
};

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

/// Refuses to replace results of another request than is asked for, and warns where those that are
/// replaced are of another version, damaged, or of a request that is not recorded: "request" in
/// summary.json. Throws UsageError.
void require_same_request(const std::filesystem::path& output, const JsonObject& asked);

/// The version of the program, to be kept in a summary.
std::string summary_version();

/// Refuses to replace results of another material than is asked for. Throws UsageError.
/// @param file  material.toml of the earlier results
void require_same_material(const std::filesystem::path& file, const std::string& asked);

} // namespace listric
