#pragma once

#include "dem/numbers/hypotenuse.hpp"

#include <optional>

namespace listric::dem {

/// Displacement gradient; xy is the change of u_x with y.
struct Gradient {
    double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;

    /// Engineering shear strain on the plane of largest shear.
    double shear() const { return hypotenuse(xx - yy, xy + yx); }
};

/// Least-squares fit of a displacement gradient to what surrounds a point.
class GradientFit {
public:
    /// @param dx, dy  place of a neighbour relative to the point, m
    /// @param ux, uy  its displacement relative to the point's, m
    void add(double dx, double dy, double ux, double uy) {
        xx_ += dx * dx;
        xy_ += dx * dy;
        yy_ += dy * dy;
        uxx_ += ux * dx;
        uxy_ += ux * dy;
        uyx_ += uy * dx;
        uyy_ += uy * dy;
    }

    /// None where the neighbours lie as good as on a line through the point, so that the gradient
    /// across it is unknown: the determinant of their moments is at most `flattest` of the product
    /// of the two along the axes. It is 1 where they lie all around and the square of the sine of
    /// their spread where that is narrow: 1e-3 asks for two degrees, 1e-6 for round-off only.
    std::optional<Gradient> gradient(double flattest) const {
        const double determinant = xx_ * yy_ - xy_ * xy_;
        if (determinant <= flattest * xx_ * yy_)
            return std::nullopt;
        return Gradient{
            (uxx_ * yy_ - uxy_ * xy_) / determinant, (uxy_ * xx_ - uxx_ * xy_) / determinant,
            (uyx_ * yy_ - uyy_ * xy_) / determinant, (uyy_ * xx_ - uyx_ * xy_) / determinant};
    }

private:
    double xx_ = 0.0, xy_ = 0.0, yy_ = 0.0;
    double uxx_ = 0.0, uxy_ = 0.0, uyx_ = 0.0, uyy_ = 0.0;
};

} // namespace listric::dem
