#pragma once

#include "dem/calendar.hpp"
#include "dem/genesis/detachment.hpp"
#include "dem/motion.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

struct Scene;

/// Column of history.csv with the travel, m.
inline constexpr const char* travel_column = "travel_m";

/// A table [[stage]]: a way of the wall, or a pause.
struct StageParameters {
    std::optional<double> distance;    ///< of the wall, m; below 0: shortening
    std::optional<double> pause;       ///< a
    std::optional<double> step;        ///< of a pause, greatest, a; none: time goes by travel
    std::optional<double> settle;      ///< travel of a step, m
    std::optional<double> rate;        ///< m/a; none: that of [extension]
    std::optional<double> speed;       ///< in the model, m/s; none: that of [extension]
    std::optional<dem::BaseKind> base; ///< none: that of the detachment
    std::optional<double> detachment_friction;
    std::optional<double> sediment_friction;
    dem::SurfaceWork surface_work = dem::SurfaceWork::both;
    std::optional<double> water_level; ///< m, reached at the stage's end; none: as before
};

/// Travel of a step of a pause where none is given, m.
inline constexpr double usual_settling = 200.0;

using Stages = std::vector<StageParameters>;

/// A pause by equal steps that are as long as asked for, or shorter.
dem::SteppedPause stepped(const StageParameters& pause, dem::Travel start);

/// Motion of base and right wall.
dem::Motion make_motion(const Scene& scene);

/// Greatest displacement of the right wall in a scene, m: how far the base must reach.
double greatest_extension(const Scene& scene);

/// Least displacement of the right wall, m: below 0 where a scene shortens more than it extends.
double least_extension(const Scene& scene);

} // namespace listric
