#pragma once

#include "apps/measures/polyline.hpp"
#include "apps/measures/setting.hpp"
#include "dem/state.hpp"

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace listric::measures {

/// Where a horizon, straight on from both sides, meets a fault.
struct Cutoffs {
    dem::Point hanging = {}, footwall = {}; ///< above the fault and below it, m
    double error = 0.0;                     ///< of the throw, m
    bool is_resolved = false;               ///< it is known well enough for a throw
    bool is_of_growth = false; ///< younger than the fault, or the surface that it broke first

    /// Height of the footwall's cutoff over the hanging wall's cutoff, m; > 0: normal.
    double height() const { return footwall.y - hanging.y; }
};

/// A fault and what lies around it.
struct ThrownFault {
    const Polyline& trace;
    dem::Travel born_at = {};                   ///< when it formed
    std::span<const Polyline> others = {};      ///< faults beyond which a horizon is another one's
    std::span<const LayerBoundary> layers = {}; ///< of rock before extension; none: every kilometre
    double unit = 0.0;                          ///< of lengths, m; 0: a mean disc's diameter
};

/// Cutoffs of all horizons that meet a fault on both sides, by the numbers of Horizon: 0 the
/// pre-rift top, n the top of the n-th stratum, -n the n-th horizon below the pre-rift top.
///
/// A horizon beside the fault is a plane through discs between 3 and 15 units away from it, where
/// neither drag nor another fault reaches, and it meets the trace where it is straight on, within 8
/// units of one of these discs and on this side of every other fault. Of rock before extension each
/// disc tells by its start how far above the horizon it is; of sediment it tells only whether it is
/// above, so that the tops of three strata in succession share one tilt. The trace is extended
/// upward by 15 units, as young sediment slips too little to be traced.
///
/// The error holds the scatter of the discs about the planes, half a unit for the place of the
/// trace and what a second way brings: other distances (3 to 15 for 3 to 9 units) or a top's own
/// tilt. A throw needs an error of at most two units and, of a stratum, a thickness of three discs
/// in the mean of both sides.
std::map<int, Cutoffs> fault_cutoffs(const dem::State& state, const ThrownFault& fault);

/// Throws by horizon of those cutoffs that have one, m.
std::map<int, double> throws_of(const std::map<int, Cutoffs>& cutoffs);

/// Throws of the strata younger than the fault and of the surface that it broke first, m.
std::map<int, double> growth_throws_of(const std::map<int, Cutoffs>& cutoffs);

/// Greatest throw of the horizons of the rock before extension, its top among them, m; of negative
/// ones the one furthest from 0. None without any. It grows with the fault's slip, where a median
/// changes with how far down the fault is traced.
std::optional<double> pre_rift_throw_of(const std::map<int, Cutoffs>& cutoffs);

} // namespace listric::measures
