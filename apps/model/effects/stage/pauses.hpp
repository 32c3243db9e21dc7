#pragma once

#include "dem/calendar.hpp"
#include "dem/event.hpp"
#include "dem/motion.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace listric::effects::stage {

/// Measure that the report judges.
inline constexpr const char* rest_strain_windows = "rest_strain_windows";

/// Way of the right wall, back and forth, up to a travel behind a pause; none before one, where the
/// travel is that way.
std::optional<dem::Extension> wall_way(const dem::Motion& motion, dem::Travel travel);

/// What a travel is: "wall motion", and behind a pause, which adds to it, "travel".
std::string_view name_of_way(const dem::Motion& motion, dem::Travel travel);

/// Strain and displacement of rock from before the rift while base and wall rest.
struct Unrest {
    double strain = 0.0;   ///< mean shear strain
    double moved = 0.0;    ///< discs that are further than `far` from where they were
    double farthest = 0.0; ///< greatest displacement of a disc, m

    static constexpr double far = 100.0; ///< m
};

/// Remembers how rock was when a pause began: columns `rest_x`, `rest_y` and `rest_strain`; and
/// what went on in the pause, a row for each.
class PauseRecord final : public dem::Observer {
public:
    explicit PauseRecord(const dem::Motion& motion);

    /// Whether a motion has a pause.
    static bool is_needed(const dem::Motion& motion);

    dem::Travel next_due() const override;
    bool begins_any_time() const override { return true; }
    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    /// Since the newest pause began, up to its end; none before the first.
    std::optional<Unrest> unrest(const dem::State& state) const;

    /// Mean shear strain of rock in the last whole window before that pause; 0 where there is none.
    double strain_before() const;

private:
    std::vector<dem::Travel> ends_; ///< when pauses begin and end, in turn
};

/// Measures of whether the steps of pauses come to rest, that the report judges.
inline constexpr const char* unsettled_steps = "unsettled_steps";
inline constexpr const char* step_unrest = "step_unrest_m";

/// Looks whether the steps of pauses come to rest: rock from before the rift, in the last quarter
/// of a step, by columns `step_x` and `step_y`. A base that moves as prescribed takes rock along
/// all the time; what it does is no unrest.
class StepRecord final : public dem::Observer {
public:
    /// A step rests if in its last quarter rock moves by less than this, mean of discs, mean radii.
    static constexpr double rest = 0.01;

    StepRecord(const dem::Calendar& calendar, bool base_is_prescribed);

    dem::Travel next_due() const override;
    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    double steps() const { return memory.get<double>("steps")[0]; }
    double unsettled() const { return memory.get<double>("unsettled")[0]; }
    double last() const { return memory.get<double>("last_m")[0]; } ///< motion, m

private:
    dem::Calendar calendar_;
    bool base_is_prescribed_;
};

} // namespace listric::effects::stage
