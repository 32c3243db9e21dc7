#pragma once

#include "fem/vector.hpp"

#include <array>
#include <string>

namespace listric::fem {

/// Area of a quadrilateral's corner at which it is smallest; its vertices are lower left, lower
/// right, upper left, upper right.
double least_corner(const std::array<Vector, 4>& v);

/// Reads nodes and elements of a Gmsh file (format 2.2, text) and refuses what deal.II would
/// misread, wait for or, like inverted cells, mend without a word. Whatever the file holds, it
/// takes memory in proportion to the file's size. Throws FootwallError: "file:line: what is wrong".
void scan_mesh(const std::string& file);

} // namespace listric::fem
