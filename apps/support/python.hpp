#pragma once

#include <string>
#include <vector>

namespace listric {

/// Runs one of the program's Python scripts. Returns an empty string, or why it could not.
std::string run_drawing_script(const std::string& script,
                               const std::vector<std::string>& arguments);

} // namespace listric
