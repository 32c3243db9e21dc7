#pragma once

#include "apps/measures/basin/profile.hpp"

#include <optional>
#include <span>
#include <vector>

namespace listric::measures {

/// Prominence from which on a maximum of a thickness or a depth is one, m.
inline constexpr double depocentre_prominence = 250.0;

/// Local maximum of a thickness or a depth, smoothed over 1 km.
struct Depocentre {
    double x = 0.0, thickness = 0.0, prominence = 0.0; ///< m
};

/// Local maxima with at least the given prominence, the thickest first.
std::vector<Depocentre> find_depocentres(std::span<const double> x,
                                         std::span<const double> thickness,
                                         double least_prominence);

/// Local maxima of the pre-rift top's depth that are prominent, the deepest first.
std::vector<Depocentre> find_basins(const Profile& profile);

/// The basins but the one nearest to the breakaway, in the same order.
std::vector<Depocentre> collapse_grabens(std::span<const Depocentre> basins);

/// Index of where the basin is shallowest between its first depocentre and the most prominent one
/// beyond; none if there is no second. `depth` in equal columns, m.
std::optional<std::size_t> find_intervening_high(std::span<const double> x,
                                                 std::span<const double> depth,
                                                 double least_prominence);

} // namespace listric::measures
