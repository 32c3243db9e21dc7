#pragma once

#include <functional>
#include <string>
#include <vector>

namespace listric {

/// Runs a program, by its path or found on PATH, without a shell, and waits for its end. Ctrl-C is
/// for this process alone.
/// @param begun  is told the number of the process, if there is one
/// @return its exit code; 128 and the signal's number, if one has ended it; -1 without a process
int run_program(const std::vector<std::string>& words,
                const std::function<void(int process)>& begun = {});

/// How a program ended whose words were kept.
struct SilentEnd {
    int code = -1;         ///< as run_program has it
    std::string said = {}; ///< the last 64 kB of its standard error
};

/// The same of a program that says nothing to the user and reads nothing from him.
SilentEnd run_silently(const std::vector<std::string>& words);

} // namespace listric
