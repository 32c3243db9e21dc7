#pragma once

// Helpers of tests of whole runs without the program's libraries: some need its executable alone.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace listric::support {

/// The beginning of a scene of 400 discs, 565 with a mean radius of 50 m.
inline std::string small_halfgraben(const std::string& mean_radius_m = "60.0") {
    return "[hanging_wall]\nlength_m = 4000.0\nthickness_m = 1500.0\nmean_radius_m = " +
           mean_radius_m + R"(
[detachment]
segments = [{arc = {radius_m = 1500.0, end_dip_deg = 0.0}}, {line = {length_m = 6000.0}}]
)";
}

/// A crust of 5 km below it: [elastic_base].
inline std::string small_elastic_base() {
    return R"([elastic_base]
skin_thickness_m = 300.0
left_m = -40000.0
right_m = 50000.0
depth_m = 5000.0
cell_size_m = 400.0
)";
}

inline std::string contents(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace listric::support
