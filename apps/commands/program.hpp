#pragma once

namespace listric {

/// The command line. Returns the exit code (apps/run/exit_code.hpp).
int program(int argc, char** argv);

} // namespace listric
