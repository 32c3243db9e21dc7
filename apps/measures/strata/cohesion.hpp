#pragma once

#include "dem/base/target_line.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace listric::measures {

/// From this depth, m, and this age, m of travel, on sediment is old: it should be rock.
inline constexpr double old_sediment_depth = 1500.0, old_sediment_age = 2e3;

/// Share of the touching pairs of pre-rift discs without bond. None if there are no such pairs.
std::optional<double> unbonded_share_of_basement(const dem::State& state);

/// Bonded share of the touching pairs of sediment discs that are both deeper than `depth` m below
/// the line that sediment is filled up to and older than `age` m of extension. None if there are no
/// such pairs.
std::optional<double> bonded_share_of_old_sediment(const dem::State& state,
                                                   const dem::TargetLine& surface, double depth,
                                                   double age);

/// Bonded share in a layer 1 km high.
struct BondedLayer {
    double depth; ///< of its middle below that line, m
    double share;
};

/// Bonded share by depth, without a least depth, in layers whose middles are whole kilometres below
/// the line: a pair is where the middle of its centres is. Layers without such pairs are left out.
std::vector<BondedLayer> bonded_profile_of_old_sediment(const dem::State& state,
                                                        const dem::TargetLine& surface, double age);

/// Unbroken bonds of every disc.
std::vector<std::int32_t> bonds_per_disc(const dem::State& state);

} // namespace listric::measures
