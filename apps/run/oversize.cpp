#include "apps/run/oversize.hpp"

#include "apps/run/prediction.hpp"
#include "apps/scene/tables.hpp"
#include "apps/support/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <type_traits>
#include <unistd.h>
#include <variant>

namespace listric {

namespace {

constexpr double most_cycles = 1e10; // standard lis1 takes 8e5

/// How often a scene is as large as may be.
struct Excess {
    double cycles; ///< of time
    double memory;

    double greatest() const { return std::max(cycles, memory); }
};

Excess excess_of(const Scene& scene, double memory) {
    const Prediction p = predict(scene);
    const double discs = std::max<double>(1.0, static_cast<double>(p.discs_at_end));
    return {std::max(p.cycles, p.work / discs) / most_cycles, p.memory / memory};
}

/// Gives a parameter of `object` the value that it has in `other`; false: it is no number.
bool take_number(const Parameter& parameter, void* object, const void* other) {
    const auto take = [&]<class T>(const T& place) {
        if constexpr (std::is_same_v<T, Place<double>> || std::is_same_v<T, Place<int>>) {
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
        return "";
    };
    return std::visit(read, parameter.value);
}

struct Cause {
    std::string parameter, value;
};

Cause cause_of(const Scene& scene, EffectList effects, double memory) {
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
                excess = excess_of(other, memory).greatest();
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

std::optional<Oversize> oversize_of(const Scene& scene, EffectList effects, double memory) {
    if (!scene.hanging_wall)
        return std::nullopt;
    const Excess excess = excess_of(scene, memory);
    if (!(excess.greatest() > 1.0))
        return std::nullopt;
    const Cause cause = cause_of(scene, effects, memory);
    const std::string size =
        excess.cycles > excess.memory
            ? fmt::format("the time of {:.2g} cycles, more than {:.0g}",
                          excess.cycles * most_cycles, most_cycles)
            : fmt::format("{:.2g} GB of memory, more than the {:.2g} GB that this machine has",
                          excess.memory * memory / 1e9, memory / 1e9);
    return Oversize{cause.parameter,
                    fmt::format("{} makes a run that takes {}; change it, or run it all the same "
                                "with --force-size",
                                cause.value, size)};
}

double machine_memory() {
    const auto pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    return pages > 0 && size > 0 ? static_cast<double>(pages) * static_cast<double>(size)
                                 : std::numeric_limits<double>::infinity();
}

} // namespace listric
