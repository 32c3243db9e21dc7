#pragma once

namespace listric {

/// The command line. Returns the exit code: 0 done, 2 bad call or scene, 3 the numerics failed,
/// 4 storage failed, 130 interrupted (Ctrl-C) with the state saved.
int program(int argc, char** argv);

} // namespace listric
