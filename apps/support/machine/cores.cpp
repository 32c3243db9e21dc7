#include "apps/support/machine/cores.hpp"

#include "apps/support/machine/job_limits.hpp"

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

#if defined __linux__
#include <sched.h>
#endif

namespace listric {

namespace {

/// Cores of the affinity mask; the C library's own count may be the machine's.
int allowed_cores() {
#if defined __linux__
    for (int most = 1024; most <= 1 << 20; most *= 4) { // until the kernel's mask fits
        std::vector<cpu_set_t> set(static_cast<std::size_t>(most) / (8 * sizeof(cpu_set_t)));
        const std::size_t bytes = set.size() * sizeof(cpu_set_t);
        if (sched_getaffinity(0, bytes, set.data()) == 0)
            return CPU_COUNT_S(bytes, set.data());
    }
#endif
    return static_cast<int>(std::thread::hardware_concurrency());
}

} // namespace

int usable_cores() {
    const double granted = std::ceil(granted_cores("/"));
    const int allowed = std::max(1, allowed_cores());
    return granted < allowed ? std::max(1, static_cast<int>(granted)) : allowed;
}

} // namespace listric
