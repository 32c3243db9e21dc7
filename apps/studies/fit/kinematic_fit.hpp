#pragma once

#include "apps/measures/strata/predicted_horizons.hpp"
#include "apps/scene/picks/observed.hpp"
#include "dem/genesis/detachment.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace listric {

/// A listric detachment: a line from the breakaway, then one arc to the flat.
struct ListricShape {
    double dip = 60.0;     ///< at the breakaway, degrees
    double depth = 15e3;   ///< of the flat, m
    double straight = 0.0; ///< share of the depth that the line takes

    bool operator==(const ListricShape&) const = default;

    double line_length() const; ///< m; 0: there is none
    double radius() const;      ///< of the arc, m
};

/// Line, arc and a flat, which a model continues as far as it needs; the friction is the default.
dem::DetachmentParameters detachment_of(const ListricShape& shape);

/// A number of the shape that is searched.
struct ShapeNumber {
    std::string_view name;        ///< in tables
    std::string_view label, unit; ///< for people
    double ListricShape::*value;
    double per_unit; ///< of that unit in one of the value
    double step;     ///< of the first drafts; of depth a share of it
    double enough;   ///< to either side, within which it is decided; of depth a share of it
    bool is_relative;
};

/// Dip, depth and share of the line.
const std::array<ShapeNumber, 3>& shape_numbers();

/// A picked horizon by what has happened since.
struct FitHorizon {
    double since = 0.0;           ///< extension since it was level at the ground, m
    std::vector<double> x, depth; ///< m
};

/// Horizons of a section after so much extension, to which a detachment is fitted.
struct FitTask {
    std::vector<FitHorizon> horizons;
    double extension = 0.0;                  ///< m
    measures::PorosityByDepth porosity = {}; ///< of the sediment
};

/// Values of a number at which the misfit is near to the least, all other numbers at their best.
struct FitRange {
    double low = 0.0, high = 0.0;
    bool low_is_end = false, high_is_end = false; ///< of what is tried: the range may go on
};

/// Least misfit at values of a number, all others at their best, m.
struct FitProfile {
    std::vector<double> values, misfit;

    /// The range about the least misfit in which it is `most` or less.
    FitRange range(double most) const;
};

/// A detachment over which inclined shear puts horizons nearest to those picked.
struct KinematicFit {
    ListricShape shape;
    double angle = 0.0;  ///< of shear, degrees from the vertical
    double misfit = 0.0; ///< root of the horizons' mean squared difference in depth, m
    std::array<FitProfile, 3> profiles; ///< by number of the shape
};

/// Misfit of the horizons that inclined shear predicts, m.
double kinematic_misfit(const FitTask& task, const ListricShape& shape, double angle);

/// Fits dip, depth, share of the line and angle: from the best of a grid of starts downhill. Of a
/// profile each value is a search of the other numbers. The same task has the same fit.
KinematicFit fit_kinematics(const FitTask& task);

} // namespace listric
