#pragma once

#include <string>
#include <vector>

namespace listric {

/// Runs a program, by its path or found on PATH, without a shell, and waits for its end. Ctrl-C is
/// for this process alone.
/// @return its exit code; 128 and the signal's number, if one has ended it; -1 without a process
int run_program(const std::vector<std::string>& words);

/// Begins a program as run_program() does; it is asked to stop (stop.hpp) if this process ends
/// first, whatever ends it (Linux).
/// @return its number; -1: there is no process
int begin_program(const std::vector<std::string>& words);

/// Waits for a process that was begun.
/// @return as run_program()
int end_of_program(int process);

/// How a program ended whose words were kept.
struct SilentEnd {
    int code = -1;         ///< as run_program has it
    std::string said = {}; ///< the last 64 kB of its standard error
};

/// Runs a program as run_program() does, without its input and output; its errors are kept. It ends
/// with this program.
SilentEnd run_silently(const std::vector<std::string>& words);

} // namespace listric
