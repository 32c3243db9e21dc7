#include "apps/commands/signals.hpp"

#include "apps/run/exit_code.hpp"

#include <atomic>
#include <csignal>
#include <unistd.h>

namespace listric {

namespace {

std::atomic<bool> stop_requested = false;
std::atomic<int> receiver = 0; ///< a process
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "signal handlers use them");

void answer_with(void (*handler)(int)) {
    for (int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1})
        std::signal(signal, handler);
    for (int signal : {SIGPIPE, SIGXFSZ})
        std::signal(signal, SIG_IGN);
}

} // namespace

void exit_on_signals() {
    answer_with([](int) { _exit(static_cast<int>(ExitCode::interrupted)); });
}

void ignore_signals() { answer_with(SIG_IGN); }

void hand_on_signals(int process) {
    receiver = process;
    answer_with([](int) { kill(receiver, SIGUSR1); });
    if (stop_requested)
        kill(process, SIGUSR1);
}

StopToken stop_on_signals() {
    answer_with([](int) { stop_requested = true; });
    return StopToken(stop_requested);
}

} // namespace listric
