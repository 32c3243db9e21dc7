#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "apps/support/words/moment_names.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace listric {

/// A picture of a section, and where its corners are.
struct Underlay {
    std::filesystem::path image;                             ///< PNG
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0; ///< x, depth, m
};

/// Where the wall's motion has stages, the run's clock as `way_m`, and behind a pause the wall's
/// own way as `wall_m`.
std::map<std::string, double> ways(const dem::Motion& motion, dem::Travel travel);

/// Writes the arrays of one moment, which apps/figures/python/frame.py describes, those of its
/// effects, and frame.json into a folder of their own. Throws StorageError.
/// @param underlay  that the section is drawn over, if there is one
/// @param names  of the run's moments; none: this one is the end of a window
void write_frame(const Observation& now, const measures::FaultReport& faults,
                 const std::filesystem::path& folder,
                 const std::optional<Underlay>& underlay = std::nullopt,
                 const std::optional<MomentNames>& names = std::nullopt);

} // namespace listric
