#pragma once

#include "apps/measures/polyline.hpp"
#include "dem/state.hpp"

#include <map>
#include <optional>

namespace listric::measures {

/// Throw of the strata younger than a fault, and of the surface that it broke first, m by stratum
/// number; 0 is the pre-rift top. Positive where the side above the fault lies deeper: normal.
/// Known to a mean disc's diameter. A stratum that is thinner than three of them beside the fault
/// has no value.
///
/// The tops of a stratum and all below it, in columns one diameter wide between 3 and 15 diameters
/// to the left and right of where the trace crosses the stratum, as two parallel lines, one per
/// side, of the mean tilt of the stratum and the two next to it; their distance is the throw. A top
/// lies between the discs below it and those above. The trace is extended upward by up to 15
/// diameters along its upper end, since young sediment slips too little to be traced.
/// @param born_at  when the fault formed
std::map<int, double> fault_throws(const dem::State& state, const Polyline& trace,
                                   dem::Travel born_at);

/// Where a stratum's top meets a fault, on both sides.
struct Cutoffs {
    double hanging = 0.0;     ///< height on the side above the fault, m
    double footwall = 0.0;    ///< height on the side below it, m
    bool is_resolved = false; ///< the stratum is thick enough for a throw

    double offset() const { return footwall - hanging; } ///< the throw, m
};

/// Cutoffs by which fault_throws() tells throws, also of strata that are too thin for one: between
/// two in succession is the thickness of the upper stratum on both sides.
std::map<int, Cutoffs> fault_cutoffs(const dem::State& state, const Polyline& trace,
                                     dem::Travel born_at);

/// Throws by stratum of those cutoffs that have one, m.
std::map<int, double> throws_of(const std::map<int, Cutoffs>& cutoffs);

/// Throw of the pre-rift layers, m: median over the layers that the trace cuts on both sides. Where
/// a layer meets the trace follows from the rigid motion since the start of the discs 3 to 9
/// diameters beside it. Unlike the throw of the pre-rift top it is there however far the two sides
/// have parted. Positive: normal. None if no layer is on both sides.
std::optional<double> pre_rift_throw(const dem::State& state, const Polyline& trace);

} // namespace listric::measures
