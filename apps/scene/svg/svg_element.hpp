#pragma once

#include <pugixml.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// An element's name without its prefix.
std::string_view svg_name(pugi::xml_node element);

/// "<g id="layer1">", as a message shows it.
std::string svg_tag(pugi::xml_node element);

/// Whether what is inside an element is not drawn where it stands (<defs>, <symbol>,
/// <clipPath>...).
bool is_store(pugi::xml_node element);

/// The elements below a node, in the order of the file, without recursion: a file may nest deeply.
/// @param drawn  those alone that are drawn where they stand
std::vector<pugi::xml_node> svg_elements(pugi::xml_node top, bool drawn = false);

/// The open line (<path>, <polyline> or <line>) that a name means: its id or else its label, or
/// that of a group with one such line in it. What is meant otherwise is said by a SceneError.
/// @param file  stands before what is wrong
pugi::xml_node find_svg_line(const pugi::xml_document& document, std::string_view name,
                             const std::string& file);

} // namespace listric
