#pragma once

#include "dem/event.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace listric::dem {

/// How pores of sediment close with depth: Phi_0 exp(-c depth).
struct PorosityLaw {
    double surface_porosity = 0.5; ///< Phi_0
    double coefficient = 4e-4;     ///< c, 1/m
};

/// Sediment of one kind, from the end of the bed before up to an age, a.
struct Bed {
    double until;
    PorosityLaw pores;
};

/// A sequence of beds. A stratum is of the bed in which its deposition ends, so that its number,
/// which discs have, tells the kind.
struct Beds {
    std::vector<Bed> list = {}; ///< by ascending age
    Schedule deposition = never;

    bool empty() const { return list.empty(); }
    std::size_t of(std::int32_t stratum) const; ///< number of the bed; 0 where there are none
    /// The law of a stratum; `of_all` where there are no beds.
    const PorosityLaw& law(std::int32_t stratum, const PorosityLaw& of_all) const;
};

} // namespace listric::dem
