#pragma once

#include "apps/scene/picks/observed.hpp"
#include "dem/numbers/point.hpp"

#include <string>
#include <vector>

namespace listric {

/// A fault of before extension, or several of a file, [[old_fault]].
struct OldFault {
    std::string name;
    std::vector<dem::Point> points; ///< x, depth, m
    std::vector<PickedLine> lines;  ///< of a file
    double width = 2.0;             ///< of its band, mean disc diameters
};

/// The old faults of a scene.
using OldFaultList = std::vector<OldFault>;

} // namespace listric
