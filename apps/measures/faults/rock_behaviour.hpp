#pragma once

#include "apps/measures/faults/fault.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace listric::measures {

/// How rock behaves that is bonded, broken or weakened the way a disc's surroundings are [paper,
/// Fig. 5].
enum class RockBehaviour : std::int32_t {
    elastic = 0,        ///< bonds mainly intact
    plastic = 1,        ///< minor faults: more than a stray crack
    weakened = 2,       ///< major faults
    unconsolidated = 3, ///< sediment whose bonds are mainly not there, yet or any more
    weak_off_fault = 4, ///< weakened, but of no fault (weakened_rock.hpp)
};

/// Share of every disc's contacts that are not bonded; 1 for a disc without contacts.
std::vector<double> unbonded_shares(const dem::State& state);

/// Class of every disc where these faults are traced.
std::vector<RockBehaviour> rock_behaviour(const dem::State& state, std::span<const Fault> faults);

/// Class of every disc, as if all that is weakened were of a fault. The spans have its share of
/// unbonded contacts, its stratum and the number of its material among `materials`.
std::vector<RockBehaviour> rock_behaviour(std::span<const double> unbonded_share,
                                          std::span<const std::int32_t> stratum,
                                          std::span<const std::uint8_t> material,
                                          std::span<const dem::Material> materials);

} // namespace listric::measures
