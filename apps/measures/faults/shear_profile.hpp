#pragma once

#include "apps/measures/faults/shear_field.hpp"
#include "dem/contacts/cells.hpp"

#include <cstddef>
#include <vector>

namespace listric::measures {

/// Shear resolved along a trace, across it: the mean of the discs within three diameters along.
class ShearProfile {
public:
    static constexpr double band = 3.0; ///< half the length of the trace that counts, diameters

    /// @param cells  of the field, two bands wide
    /// @param p, t   a point of the trace and its direction there, a unit vector
    /// @param reach  of the profile to either side, m; at least 1.5 diameters
    ShearProfile(const ShearField& field, const dem::Cells& cells, dem::Point p, dem::Point t,
                 double reach);

    double peak() const { return peak_value_; }

    /// Shear along the trace over the largest shear of any plane: 1 where the trace is that plane.
    double alignment() const { return alignment_; }

    /// Full width at half maximum, m.
    double width() const { return step_ * (side(0.5, 1) + side(0.5, -1)); }

    /// Displacement of the left side relative to the right, along the trace, m: of the discs where
    /// the zone ends, at a tenth of the peak or where another zone begins, less what turning with
    /// the zone adds to it. The integral of the shear is this number among discs in disorder; on a
    /// grid, whose rows come within a gradient's reach or leave it, a fitted shear is up to two
    /// fifths too large.
    /// @param direction  of the trace over a longer way, whose turns do not shorten the slip
    double slip(dem::Point direction) const;

private:
    double value(std::ptrdiff_t b) const { return sign_ * values_[static_cast<std::size_t>(b)]; }

    /// Steps from the peak to where the profile falls below a share of it.
    double side(double share, std::ptrdiff_t step) const;

    /// The place on one side of the peak where the zone ends and discs are.
    std::size_t end(std::ptrdiff_t step) const;

    /// Means of the discs around a place of the profile.
    struct Place {
        double weight = 0.0; ///< 0: there is no disc
        PlaneShear shear;
        double across = 0.0; ///< distance from the trace, > 0 on its left, m
        dem::Point moved;    ///< displacement, m
        double turn = 0.0;   ///< change of the displacement across the trace, along it

        void add(const Place& disc, double share);
        void divide();
    };
    static Place place_of(const ShearField& field, std::size_t k, dem::Point p, dem::Point t);

    double step_;
    std::ptrdiff_t half_, peak_ = 0;
    double peak_value_ = 0.0, sign_ = 1.0, alignment_ = 0.0;
    std::vector<Place> places_;
    std::vector<double> values_; ///< shear along the trace
};

} // namespace listric::measures
