#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace listric {

/// An array that a figure shows besides what every figure does: NAME.npy for the drawing scripts.
struct FigureLayer {
    std::string name;
    std::size_t columns = 0;  ///< 0: one dimension
    std::vector<double> rows; ///< one after the other; units as the script that reads them says
};

} // namespace listric
