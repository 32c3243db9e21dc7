#pragma once

#include "apps/figures/sections/seismic_section.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// Request of an export of a finished run.
struct ExportRequest {
    std::string kind;                      ///< one of export_kinds()
    std::filesystem::path output;          ///< the run's folder
    std::vector<std::string> formats = {}; ///< that the kind has; empty: its first
    std::vector<double> extensions = {};   ///< of the nearest snapshots, m; empty: all
    std::vector<double> wells = {};        ///< x, m, of kind well; empty: the effect's places
    SeismicOptions seismic = {};
    std::filesystem::path folder = {}; ///< of the files; empty: export of the run's
};

std::vector<std::string_view> export_kinds();

/// Writes KIND-SNAPSHOT[-OPTIONS].FORMAT, and one discs.gsd of all moments: calls
/// that ask for other things write other files. Returns the files. Throws UsageError, SceneError,
/// StorageError.
std::vector<std::filesystem::path> export_run(const ExportRequest& request);

} // namespace listric
