#pragma once

#include "dem/clocks.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace listric::dem {

/// Work of sedimentation at the surface.
enum class SurfaceWork { both, fill, erode, none };

/// x from which on the detachment's material runs along it with the wall, m: all of it, or none.
inline constexpr double runs_everywhere = -std::numeric_limits<double>::infinity();
inline constexpr double runs_nowhere = std::numeric_limits<double>::infinity();

/// Part of a run in which base and right wall move steadily, or rest.
struct MotionStage {
    Travel start = {}, end = {};
    Extension start_position = {}; ///< of the wall
    double slope = 1.0; ///< of the wall's position over travel; 0: it rests, < 0: it returns
    double speed = 0.0; ///< of travel, m/s; that of the wall is slope * speed
    double runs_from = runs_everywhere;
    std::optional<double> detachment_friction = {}; ///< in place of the surface's
    std::optional<double> sediment_friction = {};   ///< of sediment discs, in place of their own
    SurfaceWork surface = SurfaceWork::both;
};

/// Base and right wall in a cycle.
struct MotionInstant {
    double travel_speed; ///< m/s
    double speed;        ///< of the wall, m/s
    double runs_from = runs_everywhere;
    std::optional<double> friction = {}; ///< of the detachment, in place of its own
};

/// The prescribed motion of base and right wall. Its clock is the travel, which ascends even while
/// the wall rests or returns: metres at the geological rate of extension, so that age is travel
/// over that rate. The wall's position, and all else of a stage, follows from the travel.
struct Motion {
    double speed = 0.0; ///< m/s
    double ramp = 0.0;  ///< s over which the speed grows from rest

    /// One after the other; empty: the wall is pulled on and on, and its position is the travel.
    std::vector<MotionStage> stages = {};
    double runs_from = runs_everywhere; ///< of the detachment, where there are no stages

    /// Speed of travel where there are no stages, m/s.
    double speed_at(double time) const { return time < ramp ? speed * (time / ramp) : speed; }

    /// @param time  model time, s
    MotionInstant at(double time, Travel travel) const {
        if (!stages.empty())
            return staged_at(time, travel);
        const double now = speed_at(time);
        return {now, now, runs_from};
    }

    /// Displacement of the right wall since extension began, m.
    Extension position(Travel travel) const {
        return stages.empty() ? Extension(travel.m) : staged_position(travel);
    }

    /// Way of the right wall, back and forth, from one travel to a later one: a pause adds nothing.
    Extension way(Travel from, Travel to) const;

    /// Number of the stage that a travel is in; 0 where there are none.
    std::size_t stage(Travel travel) const;

    /// Whether the wall returns, or did so before it came to rest.
    bool shortens(Travel travel) const;

    /// Work at the surface between two travels, by the stage which holds their middle.
    SurfaceWork surface_work(Travel from, Travel to) const;

    /// Greatest speed of travel, m/s.
    double greatest_speed() const;

    /// Greatest speed of the right wall, m/s.
    double greatest_wall_speed() const;

    /// When it has come to a travel, s from rest. Where the speed passes zero between two stages
    /// to some seconds.
    double time_at(Travel travel) const;

    /// Greatest displacement of the right wall up to a travel.
    Extension greatest_position(Travel travel) const;

    /// Travel on each side of a change of stages over which the speed falls to zero, and grows
    /// again with a constant acceleration, m.
    static constexpr double change = 20.0;

private:
    MotionInstant staged_at(double time, Travel travel) const;
    Extension staged_position(Travel travel) const;
};

} // namespace listric::dem
