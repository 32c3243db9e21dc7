#pragma once

#include "apps/scene/picks/fault_source.hpp"
#include "dem/genesis/detachment.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// The points that a detachment was fitted to.
struct PickedFault {
    std::vector<double> x, depth;      ///< m
    double misfit = 0.0;               ///< largest distance from the detachment, m
    std::optional<DrawingPlace> drawn; ///< where a drawing was read, which scene.toml does not tell
};

/// Reads the points of a file, shifted. Throws SceneError.
FaultPoints read_fault(const FaultSource& source, const std::filesystem::path& file);

/// Fits the pieces of a detachment. Throws SceneError where points do not lead from the breakaway
/// at (0, 0) down to a flat, or are further from the fit than the tolerance, m.
PickedFault fit_detachment(dem::DetachmentParameters& detachment, const FaultPoints& fault,
                           double tolerance);

/// "detachment: 2 arcs and lines through 47 points, at most 3.2 m off (at x = 1200 m), 1.1 m in the
/// root mean square"
std::string describe(const PickedFault& picked, const dem::DetachmentParameters& detachment);

/// Objection to a detachment that turns more sharply than discs of a mean radius, m, can
/// follow; empty if it does not.
std::string too_sharp(const dem::DetachmentParameters& detachment, double mean_radius);

} // namespace listric
