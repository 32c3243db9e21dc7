#pragma once

#include "coupling/elastic_base.hpp"
#include "dem/cycle/cycle.hpp"

#include <cstdint>

namespace listric::coupling {

/// Advances discs and base by scheme strong: the base has no mass, and rests at the end of every
/// interval under the interval's mean loads, to a thousandth of its displacement or a
/// ten-thousandth of the discs' mean radius; to a thousandth of that radius where contacts that
/// open and close allow no better. An interval is repeated from its start until it does. Returns
/// how often an interval was computed, in the mean. Throws NumericalFailure if no place of the base
/// is found where it rests.
double advance_iterated(const ElasticBase& elastic, dem::State& state, const dem::RigidBase& base,
                        const dem::CyclePhysics& physics, std::int64_t cycles,
                        const dem::Execution& execution);

} // namespace listric::coupling
