#pragma once

#include "apps/scene/picks/fault_source.hpp"

#include <filesystem>

namespace listric {

/// Points along a line of a drawing (SVG 1.1: <path>, <polyline> or <line>; lines, Bezier curves,
/// elliptic arcs, and all that moves it), placed by reference points in the drawing's own
/// units: two that differ in both directions stretch it along each. Throws SceneError.
FaultPoints read_fault_svg(const FaultSource& source, const std::filesystem::path& file);

} // namespace listric
