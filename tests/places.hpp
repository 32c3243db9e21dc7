#pragma once

namespace listric {

// Constants, so that other files' constants may begin with them.
extern const char* const program_path;
extern const char* const source_folder;
extern const char* const footwall_program; ///< of fem_parallel_test; "" without the plug-in

} // namespace listric
