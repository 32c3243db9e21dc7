#pragma once

#include "apps/laboratory/specimen.hpp"

#include <cstdint>

namespace listric {

/// A rectangular sample of rock for the laboratory [paper, "Material setup and testing"].
struct SampleParameters {
    double width = 2000.0;        ///< m
    double height = 4000.0;       ///< m
    std::size_t discs = 1000;     ///< their mean radius follows from the porosity
    double radius_ratio = 1.66;   ///< largest over smallest radius [Table 1]
    double porosity = 0.17;       ///< of the packing before its stress is adjusted [Table 1]
    double stress = 1e6;          ///< isotropic, Pa, in which the discs are bonded
    double rock_density = 2600.0; ///< bulk, kg/m^3 [Table 1]
    double damping = 0.7;
    double time_step_safety = 0.95;
    double skin = 0.25;          ///< mean radii
    bool floaters_grow = true;   ///< discs with fewer than three contacts grow until they have them
    double floater_share = 0.01; ///< that may remain
    std::uint64_t seed = 1;
};

/// Mean radius, m, of the discs that fill a sample.
double mean_radius(const SampleParameters& p);

/// Discs that fill a sample at a mean radius, m.
std::size_t disc_count(const SampleParameters& p, double mean_radius);

/// The walls of a sample, as surfaces of its base. They go on beyond the corners, (0, 0) and
/// (width, height), so that outside is outside.
namespace walls {
inline constexpr std::size_t bottom = 0, top = 1, left = 2, right = 3;
}

/// Makes a settled sample of unbonded, frictionless discs (FISHTank's sequence): random small
/// discs, expanded between frictionless walls to the wanted porosity; all radii scaled to the
/// isotropic stress; floaters grown. Bonds and friction are the caller's.
/// Throws NumericalFailure if the stress is not reached, and Interrupted.
Specimen make_sample(const SampleParameters& p, const dem::Material& material, StopToken stop = {});

} // namespace listric
