#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// A horizon or a fault as it was picked on a section, or a piece of one: these have one name.
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

/// Picks that the model is compared with, and the picture of the section.
struct Observed {
    std::vector<PickedLine> horizons, faults;
    std::string picture;         ///< its file; empty: none is named
    std::vector<double> corners; ///< of the picture, upper left and lower right: x, depth, m
};

/// Why numbers are no corners of a picture in a section; empty: they are.
std::string objection_to_corners(const std::vector<double>& corners);

/// Picked lines of a file, and on which of its lines each point is.
struct PickedFile {
    std::string file;
    std::vector<PickedLine> lines;
    std::vector<std::vector<std::size_t>> rows;
};

/// Reads picked lines from a CSV file with the columns name, x_m, depth_m and, if they are there,
/// age_a, line and segment: rows of one name, line and segment, or else of one name and block by
/// empty lines, are a line, in their order. Adds `shift` to every x. Throws SceneError.
PickedFile read_picked_lines(const std::filesystem::path& file, double shift);

} // namespace listric
