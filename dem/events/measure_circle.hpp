#pragma once

#include "dem/numbers/point.hpp"
#include "dem/numbers/units.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace listric::dem {

/// Distance between the centroids of a disc's halves, 8 R / (3 pi), over its diameter.
inline constexpr double half_distance = 4.0 / (3.0 * pi);

/// Discs that the scan looks at, with their displacement since the last scan.
struct Displacements {
    std::vector<std::int32_t> row;
    std::vector<double> x, y, ux, uy; ///< m
    /// Vertical strain by compaction since then, below 0; empty where nothing compacts. What a
    /// buried column loses is no slip, though its strain is as large on planes that dip by 45
    /// degrees; the mean of a circle is taken out.
    std::vector<double> compaction;
};

/// A plane through a sampling point along which the two halves of the measure circle slid.
struct FaultSegment {
    Point centre;
    double angle = 0.0; ///< of the plane against the x axis, rad, in [0, pi)
    double slip = 0.0;  ///< displacement of the left half less the right half's, along it, m
};

/// Directions of planes at equal angles in [0, pi): (1, 0) first.
std::vector<Point> plane_directions(int angles);

/// The most active plane through a point [paper, Fig. 4d], from the discs of the circle around it.
///
/// Two cuts at right angles give the differences dU of the halves' mean displacements and dX of
/// their centroids, hence the displacement gradient H = [dU1 dU2] [dX1 dX2]^-1, which is exact for
/// any homogeneous strain. With t along a plane and n on its left, the shear strain of the plane is
/// t (H + H^T) n, to which rigid rotation adds nothing; times the distance between the halves it is
/// a slip. So a cut between rigid sides reads its slip; a shear band that is wider, less.
///
/// @param circle  indices of discs in s
/// @param diameter  of the circle, m. Where rock ends in it the halves are closer, and that counts.
/// @param planes  directions that are tried: see plane_directions()
/// @return slip 0 where discs are too few on a side or in line
FaultSegment most_active_plane(const Displacements& s, std::span<const std::int32_t> circle,
                               Point centre, double diameter, std::span<const Point> planes);

/// The segment along the fault itself: a strain is equal on two planes at right angles, and where
/// discs slide along a line in one of them only. It is the plane for which slip of two halves that
/// turn together explains most of the discs' displacements.
FaultSegment along_fault(const Displacements& s, std::span<const std::int32_t> circle,
                         const FaultSegment& f, std::span<const Point> planes);

/// No plane in the circle slips by more than this, m: what makes a search worth its while.
double slip_bound(const Displacements& s, std::span<const std::int32_t> circle, Point centre);

} // namespace listric::dem
