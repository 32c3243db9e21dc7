#pragma once

#include "dem/numbers/random.hpp"
#include "dem/state.hpp"

#include <algorithm>

namespace listric::dem {

/// Bonds contact row `k`. Strengths are normally distributed, keyed by (seed, occasion, ids): the
/// same pair gets the same strengths whatever the order of rows. A strength read as a stress acts
/// on the discs' mean section, 2 r_mean times 1 m. Between two rocks the weaker one decides, in
/// tension and in shear.
/// @param strength  of rock whose material has none of its own
inline void install_bond(State& state, std::size_t k, const BondStrength& strength,
                         std::int64_t occasion) {
    const DiscColumns d = disc_columns(state);
    const ContactColumns c = contact_columns(state);
    const auto i = static_cast<std::size_t>(c.first[k]), j = static_cast<std::size_t>(c.second[k]);
    const std::int64_t low = std::min(d.id[i], d.id[j]), high = std::max(d.id[i], d.id[j]);
    const BondStrength one = state.materials[d.material[i]].bonds.value_or(strength);
    const BondStrength other = state.materials[d.material[j]].bonds.value_or(strength);
    const auto draw = [&](Purpose purpose, double BondStrength::*mean,
                          double BondStrength::*deviation) {
        const double z =
            normal(state.seed, purpose, static_cast<std::uint64_t>(low),
                   static_cast<std::uint64_t>(high), static_cast<std::uint64_t>(occasion));
        const auto of = [&](const BondStrength& s) {
            const double section =
                s.reading == StrengthReading::stress ? d.radius[i] + d.radius[j] : 1.0;
            return static_cast<float>(std::max(0.0, s.*mean + s.*deviation * z) * section);
        };
        return std::min(of(one), of(other));
    };
    c.bonded[k] = 1;
    c.tensile_strength[k] =
        draw(Purpose::bond_tension, &BondStrength::tensile_mean, &BondStrength::tensile_deviation);
    c.shear_strength[k] =
        draw(Purpose::bond_shear, &BondStrength::shear_mean, &BondStrength::shear_deviation);
}

} // namespace listric::dem
