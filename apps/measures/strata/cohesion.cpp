#include "apps/measures/strata/cohesion.hpp"

#include "dem/contacts/contacts.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

/// Pairs of discs that touch.
struct Pairs {
    std::int64_t all = 0, bonded = 0;
};

/// Those whose rows both count, by what group(first, second) makes of them.
template <class Counts, class Group>
auto count_touching(const State& state, Counts&& counts, Group&& group) {
    const ConstContactColumns c = contact_columns(state);
    const std::vector<bool> touches = touching(state);
    std::map<decltype(group(0, 0)), Pairs> groups;
    for (std::size_t k = 0; k < touches.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]),
                   j = static_cast<std::size_t>(c.second[k]);
        if (!touches[k] || !counts(i) || !counts(j))
            continue;
        Pairs& pairs = groups[group(i, j)];
        ++pairs.all;
        pairs.bonded += c.bonded[k] ? 1 : 0;
    }
    return groups;
}

/// All of them.
template <class Counts> Pairs count_touching(const State& state, Counts&& counts) {
    return count_touching(state, counts, [](std::size_t, std::size_t) { return 0; })[0];
}

bool is_old_sediment(const State& state, const ConstDiscColumns& d, std::size_t i, double age) {
    return d.stratum[i] > 0 && state.clock.travel.m - d.start_travel[i] > age;
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

std::optional<double> bonded_share_of_old_sediment(const State& state, const TargetLine& surface,
                                                   double depth, double age) {
    const ConstDiscColumns d = disc_columns(state);
    const Pairs pairs = count_touching(state, [&](std::size_t i) {
        return is_old_sediment(state, d, i, age) && surface.height(d.x[i]) - d.y[i] > depth;
    });
    return share(pairs.bonded, pairs.all);
}

std::vector<BondedLayer> bonded_profile_of_old_sediment(const State& state,
                                                        const TargetLine& surface, double age) {
    constexpr double height = 1e3; // of a layer, m
    const ConstDiscColumns d = disc_columns(state);
    const auto layers = count_touching(
        state, [&](std::size_t i) { return is_old_sediment(state, d, i, age); },
        [&](std::size_t i, std::size_t j) {
            const double level = surface.height(0.5 * (d.x[i] + d.x[j]));
            return std::lround((level - 0.5 * (d.y[i] + d.y[j])) / height);
        });
    std::vector<BondedLayer> profile;
    for (const auto& [layer, pairs] : layers)
        if (layer > 0)
            profile.push_back(
                {static_cast<double>(layer) * height, share(pairs.bonded, pairs.all).value()});
    return profile;
}

std::vector<std::int32_t> bonds_per_disc(const State& state) {
    const ConstContactColumns c = contact_columns(state);
    std::vector<std::int32_t> bonds(state.discs.rows(), 0);
    for (std::size_t k = 0; k < c.bonded.size(); ++k)
        if (c.bonded[k]) {
            ++bonds[static_cast<std::size_t>(c.first[k])];
            ++bonds[static_cast<std::size_t>(c.second[k])];
        }
    return bonds;
}

} // namespace listric::measures
