#pragma once

#include "dem/base.hpp"

#include <vector>

namespace listric::dem {

/// The line that exogenic processes adapt the surface to [paper, "Syn-rift sedimentation"]:
/// straight between its points, level beyond the first and the last.
class TargetLine {
public:
    /// @param points  by ascending x, m; at least one
    explicit TargetLine(std::vector<Point> points);

    double height(double x) const; ///< m

    /// Distance from the line, m; negative below it.
    double above(Point p) const;

    const std::vector<Point>& points() const { return points_; }

private:
    std::vector<Point> points_;
};

/// The line at one time.
struct TargetStage {
    double time = 0.0; ///< a
    std::vector<Point> points;
};

/// A target line that changes with time: base level, or another model's output. Between two stages
/// heights change linearly; before the first and after the last they stay.
class Target {
public:
    /// @param level   where there are no stages, m
    /// @param stages  by ascending time
    Target(double level, std::vector<TargetStage> stages = {});

    TargetLine at(double time) const; ///< a

private:
    std::vector<TargetStage> stages_;
};

} // namespace listric::dem
