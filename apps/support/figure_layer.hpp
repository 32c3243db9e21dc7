#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace listric {

/// Numbers of one moment for the drawing scripts: the array NAME.npy of a frame.
struct FigureLayer {
    std::string name;
    std::size_t columns = 0; ///< of a row; 0: a plain list
    std::vector<double> rows;
};

} // namespace listric
