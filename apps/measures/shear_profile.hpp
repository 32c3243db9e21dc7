#pragma once

#include "apps/measures/shear_field.hpp"
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

    /// Displacement of the left side relative to the right, along the trace, m: the profile's
    /// integral out to a tenth of the peak or to where another zone begins.
    double slip() const;

private:
    double value(std::ptrdiff_t b) const { return sign_ * values_[static_cast<std::size_t>(b)]; }

    /// Steps from the peak to where the profile falls below a share of it.
    double side(double share, std::ptrdiff_t step) const;

    double step_;
    std::ptrdiff_t half_, peak_ = 0;
    double peak_value_ = 0.0, sign_ = 1.0, alignment_ = 0.0;
    std::vector<double> values_;
};

} // namespace listric::measures
