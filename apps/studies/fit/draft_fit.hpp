#pragma once

#include "apps/archive/folder/json_file.hpp"
#include "apps/studies/fit/kinematic_fit.hpp"
#include "apps/studies/sweep/sweep_plan.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace listric {

/// Shapes about a centre, of which a quadratic function can be known: the centre, the middles of a
/// box's faces and its corners (face-centred central composite design; Montgomery, Design and
/// Analysis of Experiments, ch. 11).
struct DraftDesign {
    ListricShape centre;
    std::array<double, 3> steps; ///< half of the box, by number of the shape

    /// A box about a shape that stays where shapes have a meaning.
    /// @param least_depth  m
    DraftDesign(const ListricShape& about, double least_depth);

    std::vector<ListricShape> shapes() const;

    /// At places in the box, each from -1 to 1.
    ListricShape shape_at(const std::array<double, 3>& place) const;
};

/// A run's shape and how far its horizons are from those picked, m; none: it failed.
struct DraftMisfit {
    ListricShape shape;
    std::optional<double> misfit;
};

/// The quadratic function of the numbers that squared misfits of drafts follow best.
struct DraftFit {
    ListricShape shape;                 ///< of the least misfit in the box
    double misfit = 0.0;                ///< there, m
    double residual = 0.0;              ///< of the misfits about the function, m
    std::array<FitProfile, 3> profiles; ///< by number of the shape
    bool at_end = false; ///< dip or depth is at an end of the box that shapes could pass
};

/// Least squares over the drafts that have not failed; none where they are too few.
std::optional<DraftFit> fit_drafts(const DraftDesign& design, std::span<const DraftMisfit> drafts,
                                   double least_depth);

/// Mean distance of all picked points from the model's horizons, by the summary of a run with
/// [observed], m; none where it compares nothing.
std::optional<double> observed_misfit(const JsonObject& summary);

/// First horizon that a run compares with nothing, and why; empty: it compares all. Misfits of
/// different horizons do not compare.
std::string uncompared_horizon(const JsonObject& summary);

/// The runs of shapes: a scene, its picks and an accuracy level. Throws SceneError.
SweepPlan plan_of_shapes(const SweepPlan& common, std::span<const ListricShape> shapes);

} // namespace listric
