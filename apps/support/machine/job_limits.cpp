#include "apps/support/machine/job_limits.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

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

/// A number; "max": no limit.
double granted_by(const fs::path& file) {
    std::ifstream in(file);
    double granted = 0.0;
    in >> granted;
    return in && granted > 0.0 ? granted : no_limit;
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

/// The least that the groups of a controller grant, each asked by a function of its folder.
template <class Unified, class Legacy>
double least_granted(const fs::path& root, const char* controller, Unified&& unified,
                     Legacy&& legacy) {
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
                least = std::min(least, least_upwards(folder, path, unified));
        else if (has_word(controllers, controller))
            for (const fs::path& folder : {mounted / controllers, mounted / controller})
                least = std::min(least, least_upwards(folder, path, legacy));
    }
    return least;
}

/// Least limit of a controller that has one file for it.
double least_granted(const fs::path& root, const char* controller, const char* unified_file,
                     const char* legacy_file) {
    return least_granted(
        root, controller, [&](const fs::path& group) { return granted_by(group / unified_file); },
        [&](const fs::path& group) { return granted_by(group / legacy_file); });
}

} // namespace

double granted_cores(const fs::path& root) {
    return least_granted(root, "cpu", granted_by_max, granted_by_quota);
}

double granted_memory(const fs::path& root) {
    return least_granted(root, "memory", "memory.max", "memory.limit_in_bytes");
}

double granted_tasks(const fs::path& root) {
    return least_granted(root, "pids", "pids.max", "pids.max");
}

} // namespace listric
