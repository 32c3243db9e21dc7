#include "apps/measures/faults/rock_behaviour.hpp"

#include "apps/measures/faults/weakened_rock.hpp"
#include "dem/contacts/contacts.hpp"

#include <cassert>

namespace listric::measures {

std::vector<double> unbonded_shares(const dem::State& state) {
    const dem::ConstContactColumns c = dem::contact_columns(state);
    const std::vector<bool> touches = dem::touching(state);
    std::vector<double> contacts(state.discs.rows(), 0.0), unbonded(state.discs.rows(), 0.0);
    for (std::size_t k = 0; k < touches.size(); ++k)
        if (touches[k] || c.bonded[k])
            for (const std::int32_t disc : {c.first[k], c.second[k]}) {
                contacts[static_cast<std::size_t>(disc)] += 1.0;
                unbonded[static_cast<std::size_t>(disc)] += !c.bonded[k];
            }
    for (std::size_t i = 0; i < contacts.size(); ++i)
        unbonded[i] = contacts[i] > 0.0 ? unbonded[i] / contacts[i] : 1.0;
    return unbonded;
}

std::vector<RockBehaviour> rock_behaviour(const dem::State& state, std::span<const Fault> faults) {
    const dem::ConstDiscColumns d = dem::disc_columns(state);
    std::vector<RockBehaviour> behaviour =
        rock_behaviour(unbonded_shares(state), d.stratum, d.material, state.materials);
    const std::vector<bool> of_fault = weakened_by_faults(state, faults);
    for (std::size_t i = 0; i < behaviour.size(); ++i)
        if (behaviour[i] == RockBehaviour::weakened && !of_fault[i])
            behaviour[i] = RockBehaviour::weak_off_fault;
    return behaviour;
}

std::vector<RockBehaviour> rock_behaviour(std::span<const double> unbonded_share,
                                          std::span<const std::int32_t> stratum,
                                          std::span<const std::uint8_t> material,
                                          std::span<const dem::Material> materials) {
    assert(stratum.size() == unbonded_share.size() && material.size() == unbonded_share.size());
    constexpr double cracked = 0.25, loose = 0.5; // of contacts
    std::vector<RockBehaviour> behaviour(unbonded_share.size(), RockBehaviour::elastic);
    for (std::size_t i = 0; i < behaviour.size(); ++i) {
        if (dem::is_weak(materials, material[i]))
            behaviour[i] = RockBehaviour::weakened;
        else if (stratum[i] > 0 && unbonded_share[i] > loose)
            behaviour[i] = RockBehaviour::unconsolidated;
        else if (unbonded_share[i] > cracked)
            behaviour[i] = RockBehaviour::plastic;
    }
    return behaviour;
}

} // namespace listric::measures
