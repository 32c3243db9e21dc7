#include "dem/threads/team.hpp"

#if defined __linux__
#include <sched.h>
#endif

namespace listric::dem {

#if defined __linux__

Pinned::Pinned(int thread, int threads) {
    cpu_set_t set;
    if (threads == 1 || sched_getaffinity(0, sizeof set, &set) != 0 || CPU_COUNT(&set) != threads)
        return;
    for (int core = 0; core < CPU_SETSIZE; ++core)
        if (CPU_ISSET(core, &set))
            before_.push_back(core);
    CPU_ZERO(&set);
    CPU_SET(before_[static_cast<std::size_t>(thread)], &set);
    sched_setaffinity(0, sizeof set, &set);
}

Pinned::~Pinned() {
    if (before_.empty())
        return;
    cpu_set_t set;
    CPU_ZERO(&set);
    for (int core : before_)
        CPU_SET(core, &set);
    sched_setaffinity(0, sizeof set, &set);
}

#else

Pinned::Pinned(int, int) {}
Pinned::~Pinned() = default;

#endif

} // namespace listric::dem
