#pragma once

#include "apps/support/machine/stop.hpp"

namespace listric {

// How a call answers SIGINT (Ctrl-C), SIGTERM, SIGHUP and SIGUSR1, which mpirun and SLURM hand on,
// and SIGUSR2, by which processes of the program ask each other. What of the first four was ignored
// when the program was started stays ignored: nohup, and a shell's background, are meant.
// Whichever it is, SIGPIPE and SIGXFSZ are ignored: whoever read the progress may leave, and a file
// that may not grow is told as one that cannot be written.

/// They end the program at once, with the exit code of an interrupted call: for what leaves nothing
/// in disorder, and until another answer is chosen.
void exit_on_signals();

/// They are requests to stop, for work that leaves things in order first.
StopToken stop_on_signals();

/// They are for another process to answer, which tells this one.
void ignore_signals();

/// Another process is asked to stop; also if it has been requested before.
void hand_on_signals(int process);

} // namespace listric
