#include "apps/measures/cohesion.hpp"

#include "dem/contacts.hpp"

#include <cstdint>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

/// Pairs of discs that touch.
struct Pairs {
    std::int64_t all = 0, bonded = 0;
};

/// Those whose rows both count.
template <class Counts> Pairs count_touching(const State& state, Counts&& counts) {
    const ConstContactColumns c = contact_columns(state);
    const std::vector<bool> touches = touching(state);
    Pairs pairs;
    for (std::size_t k = 0; k < touches.size(); ++k)
        if (touches[k] && counts(static_cast<std::size_t>(c.first[k])) &&
            counts(static_cast<std::size_t>(c.second[k]))) {
            ++pairs.all;
            pairs.bonded += c.bonded[k] ? 1 : 0;
        }
    return pairs;
}

std::optional<double> share(std::int64_t part, std::int64_t all) {
    return all ? std::optional(static_cast<double>(part) / static_cast<double>(all)) : std::nullopt;
}

} // namespace

std::optional<double> unbonded_share_of_basement(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const Pairs pairs = count_touching(state, [&](std::size_t i) { return d.stratum[i] == 0; });
    return share(pairs.all - pairs.bonded, pairs.all);
}

std::optional<double> bonded_share_of_old_sediment(const State& state, double level, double depth,
                                                   double age) {
    const ConstDiscColumns d = disc_columns(state);
    const Pairs pairs = count_touching(state, [&](std::size_t i) {
        return d.stratum[i] > 0 && level - d.y[i] > depth &&
               state.clock.extension - d.start_extension[i] > age;
    });
    return share(pairs.bonded, pairs.all);
}

} // namespace listric::measures
