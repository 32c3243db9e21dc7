#pragma once

#include <optional>
#include <vector>

namespace listric::measures {

/// A place on an axis of something that belongs to the lower side of a boundary, or should not.
struct MarkedPlace {
    double at = 0.0; ///< m
    bool below = false;
};

/// Where a boundary leaves fewest places on the wrong side, in the middle of all such, and their
/// share. None if it would be beyond all places.
struct Split {
    double at = 0.0;    ///< m
    double wrong = 0.0; ///< share of the places
};
std::optional<Split> best_split(std::vector<MarkedPlace> places);

} // namespace listric::measures
