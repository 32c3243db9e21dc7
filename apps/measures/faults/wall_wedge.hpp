#pragma once

#include "apps/measures/basin/profile.hpp"
#include "apps/measures/setting.hpp"
#include "dem/base.hpp"
#include "dem/state.hpp"

#include <optional>

namespace listric::measures {

/// What the right wall makes of rock on a base at rest, which it leaves or pushes.
struct WallWedge {
    /// Dip of the best straight line between rock that has gone at least half of the wall's way
    /// along x and rock that has not, in eight layers, degrees. None where either is missing.
    std::optional<double> border_dip;
    /// Slope of the ground that falls from beside a wall that pushes, best straight line between
    /// five sixths and a sixth of its height, degrees.
    std::optional<double> slope;
};

/// Nothing of a base that moves or has moved, or of a wall that is where it was.
WallWedge measure_wall_wedge(const Setting& setting, const dem::State& state,
                             const Profile& profile);

} // namespace listric::measures
