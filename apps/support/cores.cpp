#include "apps/support/cores.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#if defined __linux__
#include <sched.h>
#endif

namespace listric {

namespace fs = std::filesystem;

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

double cores_of(double quota, double period) {
    return quota > 0.0 && period > 0.0 ? quota / period : no_limit;
}

/// "150000 100000", of microseconds in how many; "max": all.
double granted_by_max(const fs::path& group) {
    std::ifstream in(group / "cpu.max");
    double quota = 0.0, period = 0.0;
    in >> quota >> period;
    return in ? cores_of(quota, period) : no_limit;
}

double granted_by_quota(const fs::path& group) {
    std::ifstream in_quota(group / "cpu.cfs_quota_us"), in_period(group / "cpu.cfs_period_us");
    double quota = 0.0, period = 0.0; // -1: all
    in_quota >> quota;
    in_period >> period;
    return in_quota && in_period ? cores_of(quota, period) : no_limit;
}

/// The least of a group and those above it, up to where they are mounted. In a container they may
/// begin below the path that the system knows: what is not there grants all.
template <class Granted>
double least_upwards(const fs::path& mounted, std::string path, Granted&& granted) {
    double least = granted(mounted);
    for (; path.size() > 1; path.erase(path.rfind('/')))
        least = std::min(least, granted(fs::path(mounted.string() + path)));
    return least;
}

bool has_word(std::string_view list, std::string_view word) {
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        if (list.substr(begin, end - begin) == word)
            return true;
        begin = end + 1;
    }
    return false;
}

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

double granted_cores(const fs::path& root) {
    const fs::path mounted = root / "sys/fs/cgroup";
    std::ifstream groups(root / "proc/self/cgroup");
    double least = no_limit;
    for (std::string line; std::getline(groups, line);) { // "4:cpu,cpuacct:/path", "0::/path"
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == line.npos)
            continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const std::string path = line.substr(second + 1);
        if (controllers.empty())
            for (const fs::path& folder : {mounted, mounted / "unified"})
                least = std::min(least, least_upwards(folder, path, granted_by_max));
        else if (has_word(controllers, "cpu"))
            for (const fs::path& folder : {mounted / controllers, mounted / "cpu"})
                least = std::min(least, least_upwards(folder, path, granted_by_quota));
    }
    return least;
}

int usable_cores() {
    const double granted = std::ceil(granted_cores("/"));
    const int allowed = std::max(1, allowed_cores());
    return granted < allowed ? std::max(1, static_cast<int>(granted)) : allowed;
}

} // namespace listric
