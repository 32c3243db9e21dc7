#include "apps/studies/fit/listric_shape.hpp"

#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <cmath>

namespace listric {

namespace {

constexpr double shortest_line = 1.0; ///< m
constexpr double flat = 60e3;         ///< m, as of shipped scenes

} // namespace

double ListricShape::line_length() const {
    const double length = straight * depth / dem::sine(dip * dem::pi / 180.0);
    return length < shortest_line ? 0.0 : length;
}

double ListricShape::radius() const {
    const double radians = dip * dem::pi / 180.0;
    return (depth - line_length() * dem::sine(radians)) / (1.0 - dem::cosine(radians));
}

dem::DetachmentParameters detachment_of(const ListricShape& shape) {
    dem::DetachmentParameters detachment;
    detachment.start_dip = shape.dip;
    if (shape.line_length() > 0.0)
        detachment.segments.push_back(dem::straight(shape.line_length()));
    detachment.segments.push_back(dem::arc_to_dip(0.0, shape.radius()));
    detachment.segments.push_back(dem::straight(flat));
    return detachment;
}

const std::array<ShapeNumber, 3>& shape_numbers() {
    static constexpr std::array<ShapeNumber, 3> numbers{{
        {"breakaway_dip_deg", "dip at the breakaway", "degrees", &ListricShape::dip, 1.0, 12.0, 5.0,
         false},
        {"depth_m", "depth of the flat", "km", &ListricShape::depth, 1e-3, 0.1, 0.05, true},
        {"straight", "straight share", "", &ListricShape::straight, 1.0, 0.15, 0.1, false},
    }};
    return numbers;
}

} // namespace listric
