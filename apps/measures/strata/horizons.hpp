#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/measures/polyline.hpp"
#include "apps/measures/setting.hpp"
#include "dem/base.hpp"
#include "dem/state.hpp"

#include <optional>
#include <span>
#include <vector>

namespace listric::measures {

/// The top of a stratum.
struct Horizon {
    int stratum = 0; ///< 0: pre-rift top; n: the n-th layer of sediment; -n: pre-rift
                     ///< rock that was n layers deep or deeper at the start, or below the n-th
                     ///< boundary of the setting, if that has any
    std::optional<double> deposited_at; ///< a since extension began; none before the rift
    /// The horizon from left to right, m, y up: cut at faults, absent where the stratum is.
    std::vector<Polyline> pieces;
    /// The top of this stratum and all below it, uncut, m: where the stratum is absent the top of
    /// those below. Between the tops of two strata in succession lies the area of the upper one.
    std::vector<Polyline> top;
};

struct HorizonOptions {
    double pre_rift_layer = 1000.0; ///< thickness of the layers of pre-rift rock, m; 0: no layers
};

/// Tops of all strata, the oldest first; of rock in layers their boundaries, if there are layers.
///
/// A stratum's share of the rock around a place is a mean, over its power cells, with the weights
/// of a normal distribution whose standard deviation is one mean diameter; the top of a stratum and
/// all below it is where their share is one half. So the roughness of the discs goes, a layer
/// thinner than a disc keeps its area, and tops do not cross. At a fault a horizon ends where its
/// last piece, straight on, meets the trace.
///
/// @param faults  that cut horizons; may be empty
std::vector<Horizon> trace_horizons(const Setting& setting, const dem::RigidBase& base,
                                    const dem::State& state, std::span<const Fault> faults,
                                    const HorizonOptions& options = {});

/// The top of everything, as the horizons are traced: from left to right, m, y up.
std::vector<Polyline> free_surface(const Setting& setting, const dem::RigidBase& base,
                                   const dem::State& state);

} // namespace listric::measures
