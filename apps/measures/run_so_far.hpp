#pragma once

#include "apps/measures/basin/depocentres.hpp"
#include "apps/measures/basin/profile.hpp"
#include "apps/measures/faults/shear_field.hpp"
#include "apps/measures/setting.hpp"
#include "dem/base.hpp"
#include "dem/state.hpp"

#include <span>
#include <vector>

namespace listric::measures {

/// The pre-rift discs as a packing, by id: see dilation.hpp.
struct RockPacking {
    std::vector<double> cells;   ///< power-cell areas, m^2; 0: not closed, or no such disc
    std::vector<double> overlap; ///< sum over a disc's contacts of overlap times length, m^2
    std::vector<double> reach;   ///< sum of squared lengths of those that press, m^2
};

/// Data of an earlier moment that the measures of a moment need.
struct Past {
    DiscPlaces places;
    std::vector<Depocentre> basins; ///< see find_basins
    RockPacking rock = {};          ///< of the first moment alone
};

/// A run up to one of its moments: what measures that need its past look at. It refers to what it
/// was made from, which must outlive it.
struct RunSoFar {
    /// @param past  earlier moments, oldest first
    RunSoFar(const Setting& setting, const dem::RigidBase& base, const dem::State& now,
             std::span<const Past> past);

    const Setting& setting;
    const dem::RigidBase& base;
    const dem::Chain detachment; ///< or flat base, as it was at the start
    const dem::State& now;
    std::span<const Past> past;
    dem::ConstDiscColumns discs; ///< now
    DiscPlaces places;           ///< now
    Profile profile;             ///< now
    double diameter = 0.0;       ///< mean, of the basement, m
    dem::Travel travel;          ///< now
    dem::Extension extension;    ///< now
    dem::Extension cycle;        ///< way in one: moments may miss each other by as much
    ShearField last_window;      ///< since the last of the past; empty if there is none

    /// Shear from past[k] to the moment after it, of the discs that are still there.
    ShearField window(std::size_t k) const;

    /// Places at the end of that window.
    const DiscPlaces& end_of_window(std::size_t k) const;

    /// Whether one extension is another or above it: both belong to moments, to half a cycle.
    bool has_come_to(dem::Extension at, dem::Extension asked) const {
        return dem::has_come_to(at, asked, cycle);
    }

    /// Row now of the disc k of a field; it must still be there.
    std::size_t row(const ShearField& field, std::size_t k) const;
};

} // namespace listric::measures
