#pragma once

#include "dem/base.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/state.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace listric::measures {

/// Where the discs of a state are: what the history of faults needs of it.
struct DiscPlaces {
    explicit DiscPlaces(const dem::State& state);

    dem::Travel travel;
    dem::Extension extension;
    double time_step = 0.0;           ///< s
    double diameter = 0.0;            ///< mean of the basement, m
    std::vector<double> x, y;         ///< m
    std::vector<std::int64_t> id;     ///< of the disc in the row
    std::vector<std::int32_t> row_of; ///< of the disc with the id; -1: none
    std::vector<double> age;          ///< travel since the disc was deposited, m; basement: all
};

/// Shear strain in the plane, whatever the direction, or a sum of such.
struct PlaneShear {
    double stretch = 0.0; ///< u_xx - u_yy
    double turn = 0.0;    ///< u_xy + u_yx

    /// Engineering shear strain on the plane of largest shear, without sign.
    double size() const { return dem::hypotenuse(stretch, turn); }

    /// Engineering shear strain on a plane of direction t (unit vector): > 0 where the left side
    /// moves along t relative to the right side.
    double along(dem::Point t) const {
        // n = (-t.y, t.x): n (grad u) t + t (grad u) n, the first the change of u_t with n.
        return turn * (t.x * t.x - t.y * t.y) - 2.0 * t.x * t.y * stretch;
    }
};

/// Displacement gradient of discs between two states of a run.
///
/// A least-squares fit to the displacements of the neighbours within 1.9 mean diameters. A sharp
/// step then looks 2.3 diameters wide (full width at half maximum); the strain columns of
/// dem/events/strain, whose reach is 2.6, would make it 3.2.
struct ShearField {
    std::vector<double> x, y;           ///< where the discs are in the later state, m
    std::vector<std::int64_t> id;       ///< of the discs
    std::vector<double> xx, xy, yx, yy; ///< xy: change of u_x with y
    std::vector<double> dx, dy;         ///< displacement, m
    double diameter = 0.0;              ///< mean of the basement, or what coarsen() made of it, m
    double discs_across = 1.0;          ///< mean diameters in that
    dem::Extension window;              ///< way of the wall between the states

    /// Engineering shear strain of disc k, without sign.
    double shear(std::size_t k) const { return components(k).size(); }

    PlaneShear components(std::size_t k) const { return {xx[k] - yy[k], xy[k] + yx[k]}; }
};

/// Fits the gradients of a field whose points are known, and where they were before, m; sets the
/// displacements, too.
void fit_gradients(ShearField& field, std::span<const double> old_x, std::span<const double> old_y);

/// Unit of lengths in which faults are looked for: a mean disc's diameter, or that of a standard
/// disc in a hanging wall of that thickness if it is more, m.
double unit_of_faults(double diameter, double thickness);

/// Lets the field be looked at in units of at least `unit` m instead of a disc's diameter: among
/// small discs a fault is a zone of tens of them, whose width is no matter of theirs.
void coarsen(ShearField& field, double unit);

/// Discs of both states that are `least_age` old in `now` or belong to the basement.
/// @param motion  of the wall
ShearField shear_field(const DiscPlaces& before, const DiscPlaces& now, dem::Travel least_age,
                       const dem::Motion& motion = {});

} // namespace listric::measures
