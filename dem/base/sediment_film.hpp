#pragma once

#include "dem/base.hpp"
#include "dem/base/target_line.hpp"
#include "dem/beds.hpp"
#include "dem/event.hpp"

#include <optional>

namespace listric::dem {

/// A film of sediment at one moment.
struct FilmNow {
    TargetLine target;  ///< its top
    double most;        ///< thickness, m
    double left, right; ///< where it lies, m
    double porosity;

    /// Thickness at x on ground of a height, m.
    double thickness(double x, double ground) const;
};

/// Sediment that no disc stands for. Strata come as layers of discs; until a disc has room the
/// space between ground and target is full of sediment all the same. It is as thick as that, at
/// most a mean disc's diameter: what is higher no disc of the next stratum may reach, either. It
/// goes as discs come, and has no memory.
struct SedimentFilm {
    Target target{0.0};
    Schedule deposition = never; ///< of the strata
    double surface_porosity = 0.5;
    Beds beds = {};
    double wall_x = 0.0; ///< right end of the hanging wall before extension, m

    /// What strata are laid down up to at a travel.
    TargetLine target_at(Travel travel) const;

    /// Now; none where the present stage does not fill.
    std::optional<FilmNow> now(const State& state, const RigidBase& base) const;
};

} // namespace listric::dem
