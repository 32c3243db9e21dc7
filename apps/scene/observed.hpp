#pragma once

#include <cstddef>
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
    std::string horizons, faults;  ///< files
    std::optional<double> shift_x; ///< added to every x, m; none: as that of the detachment
};

/// Picks that the model is compared with.
struct Observed {
    std::vector<PickedLine> horizons, faults;
};

/// Picked lines of a file, and on which of its lines each point is.
struct PickedFile {
    std::string file;
    std::vector<PickedLine> lines;
    std::vector<std::vector<std::size_t>> rows;
};

/// Reads picked lines from a CSV file with the columns name, x_m, depth_m and, if it is there,
/// age_a, which may be empty: rows of one name are one line, in their order. Adds `shift` to every
/// x. Throws SceneError.
PickedFile read_picked_lines(const std::filesystem::path& file, double shift);

} // namespace listric
