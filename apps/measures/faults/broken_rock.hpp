#pragma once

#include "dem/state.hpp"

namespace listric::measures {

/// How wide the zones are in which bonds of the basement are broken.
struct BrokenRock {
    double width = 0.0;       ///< mean distance of broken from sound rock, mean diameters
    double areal_share = 0.0; ///< of the basement's area: broken and far from sound rock
};

/// A pre-rift disc is of broken rock if, of the touching pre-rift pairs whose middles lie within
/// 1.6 mean diameters of it, 35 % or more have no bond, or if there are none. Distances are those
/// of its centre from the nearest centre of a disc of sound rock, at most 64 diameters; means are
/// weighted by the discs' area. In a strip the mean distance is a quarter of its width.
BrokenRock measure_broken_rock(const dem::State& state);

} // namespace listric::measures
