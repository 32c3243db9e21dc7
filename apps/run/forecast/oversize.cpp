#include "apps/run/forecast/oversize.hpp"

#include "apps/run/forecast/prediction.hpp"
#include "apps/scene/toml/tables.hpp"
#include "apps/support/machine/job_limits.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <sys/resource.h>
#include <type_traits>
#include <unistd.h>
#include <variant>

namespace listric {

namespace {

constexpr double most_cycles = 1e10; // standard lis1 takes 8e5
constexpr double most_growth = 5.0;  // of the number of discs; standard lis1 grows by 1.3

/// How often a scene is as large as may be.
struct Excess {
    double cycles; ///< of time
    double memory, disk;
    double growth;

    double greatest() const { return std::max({cycles, memory, disk, growth}); }
};

double growth_of(const Prediction& p) {
    return static_cast<double>(p.discs_at_end) /
           std::max<double>(1.0, static_cast<double>(p.discs_at_start));
}

Excess excess_of(const Prediction& p, const FreeSpace& room) {
    const double discs = std::max<double>(1.0, static_cast<double>(p.discs_at_end));
    return {std::max(p.cycles, p.work / discs) / most_cycles, p.memory / room.memory,
            p.disk / room.disk, growth_of(p) / most_growth};
}

/// Greatest excess.
std::string size_of(const Prediction& p, const FreeSpace& room) {
    const Excess excess = excess_of(p, room);
    const double greatest = excess.greatest();
    if (greatest == excess.growth)
        return fmt::format("fills the basin with about {} discs, {:.0f} times the {} at the start",
                           p.discs_at_end - p.discs_at_start, growth_of(p) - 1.0, p.discs_at_start);
    if (greatest == excess.cycles)
        return fmt::format("takes the time of {:.2g} cycles, more than {:.0g}",
                           excess.cycles * most_cycles, most_cycles);
    if (greatest == excess.memory)
        return fmt::format("takes {:.2g} GB of memory, more than the {:.2g} GB that this {}",
                           p.memory / 1e9, room.memory / 1e9,
                           room.is_job ? "job may use" : "machine has");
    return fmt::format("writes {:.0f} snapshots, with all else {:.2g} GB, more than the {:.2g} GB "
                       "that are free on the disk",
                       p.snapshots, p.disk / 1e9, room.disk / 1e9);
}

/// Gives a parameter of `object` the value that it has in `other`; false: it is of no kind that
/// makes a run large.
bool take_number(const Parameter& parameter, void* object, const void* other) {
    const auto take = [&]<class T>(const T& place) {
        if constexpr (std::is_same_v<T, Place<double>> || std::is_same_v<T, Place<int>> ||
                      std::is_same_v<T, Place<std::vector<dem::TargetStage>>>) {
            place.reach(object) = place.get(other);
            return true;
        }
        return false;
    };
    return std::visit(take, parameter.value);
}

std::string value_of(const Parameter& parameter, const void* object) {
    const auto read = [&]<class T>(const T& place) -> std::string {
        if constexpr (std::is_same_v<T, Place<double>>)
            return text(place.get(object) * parameter.per_si);
        else if constexpr (std::is_same_v<T, Place<int>>)
            return std::to_string(place.get(object));
        return "it";
    };
    return std::visit(read, parameter.value);
}

struct Cause {
    std::string parameter, value;
};

Cause cause_of(const Scene& scene, EffectList effects, const FreeSpace& room) {
    Cause cause;
    double least = std::numeric_limits<double>::infinity();
    for (const SceneTable& table : scene_tables(effects)) {
        const void* const part = table.find(table, scene);
        if (!part)
            continue;
        for (const Parameter& parameter : table.parameters) {
            Scene defaults, other = scene;
            if (!take_number(parameter, table.add(table, other), table.add(table, defaults)))
                continue;
            double excess = least;
            try {
                excess = excess_of(predict(other), room).greatest();
            } catch (const std::exception&) {
                continue; // that default does not go with the rest of the scene
            }
            if (excess < least) {
                least = excess;
                cause = {fmt::format("{}.{}", table.name, parameter.key),
                         value_of(parameter, part)};
            }
        }
    }
    return cause;
}

} // namespace

std::optional<Oversize> oversize_of(const Scene& scene, EffectList effects, const FreeSpace& room) {
    const Prediction p = predict(scene);
    const Excess excess = excess_of(p, room);
    if (!(excess.greatest() > 1.0))
        return std::nullopt;
    const Cause cause = cause_of(scene, effects, room);
    return Oversize{cause.parameter,
                    fmt::format("{} makes a run that {}; change it, or run it all the same with "
                                "--force-size",
                                cause.value, size_of(p, room)),
                    excess.disk == excess.greatest()};
}

FreeSpace room_for(const std::filesystem::path& output) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    const auto pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    FreeSpace room{unknown, unknown};
    if (pages > 0 && size > 0)
        room.memory = static_cast<double>(pages) * static_cast<double>(size);
    rlimit addresses{};
    double granted = granted_memory("/");
    if (getrlimit(RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur != RLIM_INFINITY)
        granted = std::min(granted, static_cast<double>(addresses.rlim_cur));
    room.is_job = granted < room.memory;
    room.memory = std::min(room.memory, granted);
    std::error_code error;
    std::filesystem::path place = std::filesystem::absolute(output, error);
    while (!error && !std::filesystem::exists(place, error) && place != place.parent_path())
        place = place.parent_path();
    const auto space = std::filesystem::space(place, error);
    // A folder without a size is no disk (/proc): writing there fails with the reason.
    if (!error && space.available != static_cast<std::uintmax_t>(-1) && space.capacity > 0)
        room.disk = std::max(1.0, static_cast<double>(space.available));
    return room;
}

} // namespace listric
