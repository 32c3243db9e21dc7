#pragma once

#include <string>
#include <vector>

namespace listric {

/// Runs one of the program's Python scripts that draw, whatever the caller's Python, Matplotlib and
/// language are set to. Throws UsageError if there is no Python with NumPy and Matplotlib or the
/// script refuses what it is given, StorageError if there is no room, runtime_error if it is wrong.
void run_drawing_script(const std::string& script, const std::vector<std::string>& arguments);

/// Runs a drawing script; its failure is a warning on stderr.
void draw_or_warn(const std::string& script, const std::vector<std::string>& arguments);

/// Runs a script that needs another module than Matplotlib, of a Debian package.
void run_script_with(const std::string& module, const std::string& package,
                     const std::string& script, const std::vector<std::string>& arguments);

} // namespace listric
