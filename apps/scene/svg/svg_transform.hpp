#pragma once

#include <Eigen/Geometry>

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace listric {

/// Width and height of what a drawing's lengths in percent refer to, units; none where they are not
/// said.
struct SvgViewport {
    std::optional<double> width, height;
};

/// An attribute `transform` (SVG 1.1, section 7.6; units as in CSS are allowed). Throws SceneError.
/// @param where  stands before what is wrong
Eigen::Affine2d svg_transformation(std::string_view text, const std::string& where);

/// A property `transform` of CSS, in which angles and lengths have units. Throws SceneError.
Eigen::Affine2d css_transformation(std::string_view text, const std::string& where);

/// The declarations of an attribute `style`, names in small letters.
std::map<std::string, std::string> css_declarations(std::string_view style);

/// A length, units (CSS: 96 to the inch).
/// @param whole  that 100 % stand for, if it is known
double svg_length(std::string_view text, std::optional<double> whole, const std::string& where);

/// Transform of an inner <svg> by `viewBox` and `preserveAspectRatio` (SVG 1.1, section 7.8).
/// @param size  of the viewport that it fills; on return of the view box
Eigen::Affine2d svg_view(std::string_view view_box, std::string_view aspect, SvgViewport& size,
                         const std::string& where);

} // namespace listric
