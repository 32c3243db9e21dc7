#pragma once

#include "dem/genesis/detachment.hpp"

#include <array>
#include <cstddef>
#include <string_view>

namespace listric {

/// A listric detachment: a line from the breakaway, then one arc to the flat.
struct ListricShape {
    double dip = 60.0;     ///< at the breakaway, degrees
    double depth = 15e3;   ///< of the flat, m
    double straight = 0.0; ///< share of the depth that the line takes

    bool operator==(const ListricShape&) const = default;

    double line_length() const; ///< m; 0: there is none
    double radius() const;      ///< of the arc, m
};

/// Line, arc and a flat, which a model continues as far as it needs; the friction is the default.
dem::DetachmentParameters detachment_of(const ListricShape& shape);

/// A number of the shape that is searched.
struct ShapeNumber {
    std::string_view name;        ///< in tables
    std::string_view label, unit; ///< for people
    double ListricShape::*value;
    double per_unit; ///< of that unit in one of the value
    double step;     ///< of the first drafts; of depth a share of it
    double enough;   ///< to either side, within which it is decided; of depth a share of it
    bool is_relative;
};

/// Dip, depth and share of the line.
const std::array<ShapeNumber, 3>& shape_numbers();

} // namespace listric
