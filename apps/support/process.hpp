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

} // namespace listric
