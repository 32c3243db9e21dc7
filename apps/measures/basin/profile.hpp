#pragma once

#include "apps/measures/setting.hpp"
#include "dem/base.hpp"
#include "dem/state.hpp"

#include <optional>
#include <span>
#include <vector>

namespace listric::measures {

/// Surfaces along x, in columns one mean disc diameter wide.
struct Profile {
    std::vector<double> x;                  ///< middle of the column, m
    std::vector<double> pre_rift_top;       ///< m, y up; the detachment where it is exposed
    std::vector<double> sediment_thickness; ///< m, smoothed over 1 km
};

Profile measure_profile(const Setting& setting, const dem::State& state,
                        const dem::RigidBase& base);

/// Moving average over 1 km, over less at the ends.
/// @param column  distance of the values, m
std::vector<double> smoothed(std::span<const double> values, double column);

/// Depth of the pre-rift top below the original surface, smoothed over 1 km, by column, m.
std::vector<double> smoothed_depth(const Profile& profile);

/// Area between the pre-rift top and the original surface in the first `columns` columns of
/// `width` m, m^2.
double area_above(const Profile& profile, std::size_t columns, double width);

/// Area above the pre-rift top at the start, m^2: a packing's top is rough, and some tens of metres
/// from the original surface.
double area_above_start(const Setting& setting, const dem::State& state);

/// Where the pre-rift top meets the detachment as it stands, x and depth, m: the shallowest
/// pre-rift discs that lie on it. None if none does.
std::optional<dem::Point> find_cutoff(const dem::State& state, const dem::Chain& detachment);

} // namespace listric::measures
