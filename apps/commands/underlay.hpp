#pragma once

#include "apps/figures/frame.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// --underlay and --corners as they were given.
struct UnderlayOptions {
    std::string image;
    std::vector<double> corners; ///< x0, depth0, x1, depth1, m
};

void add_underlay(CLI::App& command, UnderlayOptions& options);

/// Refuses what are no corners of a picture. Throws UsageError.
void require_corners(const std::vector<double>& corners);

/// Throws UsageError.
/// @param runs  folders whose scenes may have the picture's corners
std::optional<Underlay> underlay_of(const UnderlayOptions& options,
                                    const std::vector<std::filesystem::path>& runs);

} // namespace listric
