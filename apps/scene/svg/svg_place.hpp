#pragma once

#include <Eigen/Geometry>
#include <pugixml.hpp>

#include <string>

namespace listric {

/// How an element lies in the drawing, in units of the outer <svg> (those of its viewBox): the
/// transformations of the element and of all that it is in, as attributes or styles, and inner
/// <svg>. What is not read there, or not drawn, is refused by name: SceneError.
/// @param where  stands before what is wrong
Eigen::Affine2d place_in_drawing(pugi::xml_node element, const std::string& where);

} // namespace listric
