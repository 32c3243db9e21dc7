#pragma once

#include "apps/scene/observed.hpp"
#include "dem/point.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric {

/// A fault of before extension, or several of a file, [[old_fault]].
struct OldFault {
    std::string name;
    std::vector<dem::Point> points; ///< x, depth, m
    std::vector<PickedLine> lines;  ///< of a file
    std::optional<double> width;    ///< of its band, mean disc diameters; none: the detection's
};

/// The old faults of a scene.
using OldFaultList = std::vector<OldFault>;

} // namespace listric
