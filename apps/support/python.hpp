#pragma once

#include <string>
#include <vector>

namespace listric {

/// Runs one of the program's Python scripts. Returns an empty string, or why it could not.
std::string run_drawing_script(const std::string& script,
                               const std::vector<std::string>& arguments);

/// The same; why it could not is a warning on stderr.
void draw_or_warn(const std::string& script, const std::vector<std::string>& arguments);

/// Runs one of the program's Python scripts that needs a module, of a Debian package. Throws
/// UsageError if there is no such module, StorageError if the script fails.
void run_script_with(const std::string& module, const std::string& package,
                     const std::string& script, const std::vector<std::string>& arguments);

} // namespace listric
