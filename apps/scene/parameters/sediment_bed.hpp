#pragma once

#include "apps/scene/parameters/sediment_pores.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric {

/// Sediment of a kind of its own, [[bed]], laid down after the bed before it. What is not there is
/// as in the scene's own sediment.
struct SedimentBed {
    std::string name;
    std::optional<double> until; ///< age at which the next one begins, a; none: it is the last
    std::optional<double> surface_porosity, coefficient, permeability, specific_surface,
        clay_fraction;
    std::optional<fluid::PermeabilityLaw> law;
    std::optional<double> ratio; ///< of permeability along bedding to that across
    std::optional<double> fault_along, fault_across;
    std::optional<double> laminae; ///< share of the sediment that is thin beds of another kind
};

/// The beds of a scene, from the oldest on.
using SedimentBeds = std::vector<SedimentBed>;

} // namespace listric
