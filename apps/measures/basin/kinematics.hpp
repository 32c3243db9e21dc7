#pragma once

#include "apps/measures/basin/profile.hpp"
#include "dem/base.hpp"

#include <optional>
#include <span>
#include <vector>

namespace listric::measures {

// Where rigid footwall and slip alone would put the pre-rift top, for a detachment that is a chain
// of lines and arcs from the breakaway at the origin downward. y up, extension in m.

/// Hanging wall that shears on parallel planes inclined by `angle` degrees from the vertical, > 0
/// antithetic to the detachment (0: chevron construction; White et al. 1986). Conserves area. From
/// the cutoff to x = right.
std::vector<dem::Point> inclined_shear_top(const dem::Chain& detachment, double extension,
                                           double angle, double right);

/// That hanging wall as it is drawn, in curves with points so far apart, m.
struct ShearedSection {
    /// Where the surface is after all of the extension, after an equal part less, and so on to 0.
    std::vector<std::vector<dem::Point>> tops;
    std::vector<std::vector<dem::Point>> layers; ///< what was flat at equal parts of its depth
    dem::Point deepest;                          ///< of the top
};

ShearedSection sheared_section(const dem::Chain& detachment, double extension, double angle,
                               double right, double spacing, int tops, int layers);

/// Hanging wall whose detachment-normal lines stay normal and keep their length while they slip
/// along it (Braun et al. 1994). The head block rotates by extension / radius on an arc. Between
/// points whose normals part, a gap opens: there the hanging wall collapses.
std::vector<dem::Point> normals_top(const dem::Chain& detachment, double extension, double right);

/// Share of the basin's area (extension times depth of the flat) that lies left of the crest of
/// `normals_top`, in (0, 1).
double normals_halfgraben_share(const dem::Chain& detachment, double extension, double right);

/// Rotation of the head block if normals stay normal: the detachment's dip at the breakaway less
/// that one extension further down, degrees.
double normals_tilt(const dem::Chain& detachment, double extension);

/// Angle at which inclined shear fits a pre-rift top best, degrees, and root-mean-square distance
/// in height, m.
struct InclinedShearFit {
    double angle = 0.0, misfit = 0.0;
};

/// @param x, top  the pre-rift top in columns of equal width, the detachment where it is exposed, m
InclinedShearFit fit_inclined_shear(const dem::Chain& detachment, double extension,
                                    std::span<const double> x, std::span<const double> top);

/// Root-mean-square height difference between columns and a predicted top, m, over the columns up
/// to x = last. Left of the prediction's first point the detachment is exposed.
double misfit(const dem::Chain& detachment, const std::vector<dem::Point>& prediction,
              std::span<const double> x, std::span<const double> top, double last);

/// Length of the detachment down to where it dips least, before it steepens again by 5 degrees or
/// more: the piece that turns the head block, m. 0 of a plane.
double turning_length(const dem::Chain& detachment);

/// Whether some of the head block is still on that piece. Beyond, it has turned by as much as it
/// can, whatever the extension. On a plane it never turns, which is a result.
bool head_block_turns(const dem::Chain& detachment, double extension);

/// Predictions of the constructions for a basin, each as far as it reaches.
struct KinematicPrediction {
    std::optional<InclinedShearFit> shear; ///< that fits the pre-rift top best; none at the end of
                                           ///< the angles that are tried
    std::optional<double> normals_misfit;  ///< of the head block, m; while it is on the first piece
    std::optional<double> tilt;            ///< of the head block, degrees; while it turns
    std::optional<dem::Point> cutoff;      ///< x and depth, m
    std::optional<double> halfgraben_share;
};

/// @param extension  above 0, m
KinematicPrediction predict_kinematics(const dem::Chain& detachment, double extension,
                                       const Profile& profile);

} // namespace listric::measures
