#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// A horizon or a fault as it was picked on a section.
struct PickedLine {
    std::string name;
    std::optional<double> age;    ///< before the end of extension, a
    std::vector<double> x, depth; ///< of its points, m
};

/// Where picks are: keys of [observed] that are no part of a scene.
struct ObservedSource {
    std::string horizons, faults; ///< files
};

/// What the model is compared with.
struct Observed {
    std::vector<PickedLine> horizons, faults;
};

/// Reads picked lines from a CSV file with the columns name, x_m, depth_m and, if it is there,
/// age_a: rows of one name are one line, in their order. Throws SceneError.
std::vector<PickedLine> read_picked_lines(const std::filesystem::path& file);

} // namespace listric
