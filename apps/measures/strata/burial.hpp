#pragma once

#include "apps/measures/setting.hpp"
#include "dem/base.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <map>
#include <vector>

namespace listric::measures {

/// Rock of one stratum that a well meets, and how much was laid down where that rock came from.
struct WellStratum {
    std::vector<std::int64_t> ids; ///< of its discs, ascending
    dem::Travel deposited_at;
    double deposited_thickness = 0.0; ///< m, with the porosity as deposited
};

/// Strata by number from 1, the oldest.
using WellRock = std::map<int, WellStratum>;

/// Half of a well's width, m.
double half_well(const dem::State& state);

/// Sediment within half_well() of x, m. A stratum's deposited thickness is the grains of all its
/// discs that entered the model within half_well() of the mean place where the well's discs did,
/// over the width and 1 - porosity as deposited. Eroded discs are not among them.
/// @param grain_density  kg/m3
WellRock rock_of_well(const Setting& setting, const dem::State& state, double grain_density,
                      double x);

/// A stratum of a well at a moment: means over half_well() to either side of its own discs.
struct BuriedStratum {
    int stratum = 0;
    double x = 0.0;               ///< mean of its discs, m
    double ground = 0.0;          ///< depth of the ground below the original surface, m
    double top = 0.0, base = 0.0; ///< depth below the original surface, m
    double porosity = 0.0;        ///< share of the volume that grains do not fill
};

/// Strata of a well at an earlier moment of its run or the one at which it is drilled: those that
/// are there, the oldest first. A top is as deep as younger strata are thick, below the ground;
/// thicknesses are areas of power cells (see OwnerMap) over the width.
std::vector<BuriedStratum> buried_strata(const Setting& setting, const dem::RigidBase& base,
                                         const dem::State& state, double grain_density,
                                         const WellRock& rock);

} // namespace listric::measures
