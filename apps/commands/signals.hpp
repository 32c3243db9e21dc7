#pragma once

#include "apps/support/stop.hpp"

namespace listric {

// How a call answers SIGINT (Ctrl-C), SIGTERM and SIGHUP. Whichever it is, SIGPIPE is ignored:
// whoever read the progress may leave.

/// They end the program at once, with the exit code of an interrupted call: for what leaves nothing
/// in disorder, and until another answer is chosen.
void exit_on_signals();

/// They are requests to stop, for work that leaves things in order first.
StopToken stop_on_signals();

} // namespace listric
