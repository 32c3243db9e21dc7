#include "apps/commands/signals.hpp"

#include "apps/run/exit_code.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <unistd.h>

namespace listric {

namespace {

std::atomic<bool> stop_requested = false;
std::atomic<int> receiver = 0; ///< a process
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "signal handlers use them");

constexpr std::array requests{SIGINT, SIGTERM, SIGHUP, SIGUSR1};

/// Whether whoever started this program did not want it to hear a signal: nohup, or a shell that
/// put it into the background.
bool was_ignored(int signal) {
    struct sigaction before {};
    return sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN;
}

void answer_with(void (*handler)(int)) {
    static const auto ignored = [] { // at the first call, which is the program's first
        std::array<bool, requests.size()> all{};
        std::ranges::transform(requests, all.begin(), was_ignored);
        return all;
    }();
    for (std::size_t k = 0; k < requests.size(); ++k)
        if (!ignored[k])
            std::signal(requests[k], handler);
    std::signal(request_to_stop, handler);
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
    answer_with([](int) { kill(receiver, request_to_stop); });
    if (stop_requested)
        kill(process, request_to_stop);
}

StopToken stop_on_signals() {
    answer_with([](int) { stop_requested = true; });
    return StopToken(stop_requested);
}

} // namespace listric
