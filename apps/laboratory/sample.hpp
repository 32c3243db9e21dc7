#pragma once

#include "apps/support/machine/stop.hpp"
#include "dem/base.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/state.hpp"

#include <cstddef>
#include <cstdint>

namespace listric {

/// Discs between walls that are moved by whoever tests them. The base's extension speed is 1 m/s,
/// so that Clock::extension is the time in seconds and a surface's translation its velocity in m/s.
class Specimen {
public:
    dem::State state;
    dem::RigidBase base;
    dem::CyclePhysics physics;
    dem::Cycle cycle = dem::best_cycle();
    StopToken stop;

    /// Lets a surface go on with a velocity, m/s, from where it is.
    void steer(std::size_t surface, dem::Point velocity);

    /// Gives a surface another shape and place.
    void reshape(std::size_t surface, const dem::Chain& chain, dem::Point velocity);

    /// Where the first point of a surface is now, m.
    dem::Point place_of(std::size_t surface) const;

    /// Advances on one thread; neighbour lists stay valid however the surfaces were steered.
    /// Throws Interrupted if a stop is requested.
    void advance(std::int64_t cycles);

    double time() const { return state.clock.travel.m; } ///< s

private:
    double surface_travel_ = 0.0; ///< upper bound since the surfaces were searched, m
};

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
