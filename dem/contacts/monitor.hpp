#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"

#include <cstddef>
#include <limits>
#include <vector>

namespace listric::dem {

/// Two discs that touch or are bonded.
struct PairForce {
    std::size_t first, second; ///< rows of the disc table
    Point force;               ///< on the second, N
};

/// A disc that touches the base.
struct BaseForce {
    std::size_t disc, surface;
    Point foot;  ///< of the disc on the surface, m
    Point force; ///< on the disc, N
};

/// Forces of all contacts, by row of their tables.
struct ContactForces {
    std::vector<PairForce> pairs;
    std::vector<BaseForce> base;
};

/// A part of the x axis, m.
struct SectionStrip {
    double from = -std::numeric_limits<double>::infinity();
    double to = std::numeric_limits<double>::infinity();

    bool holds(double x) const { return from <= x && x <= to; }
};

/// Forces as they stand, of the contacts of discs whose centres are in the strip.
ContactForces contact_forces(const State& state, const RigidBase& base, SectionStrip strip = {});

/// Their sum on every disc, N.
std::vector<Point> net_forces(const ContactForces& contacts, std::size_t discs);

/// How far the state is from equilibrium [paper, "PFC2D: general features"].
struct ForceBalance {
    double mean_unbalanced = 0.0; ///< mean resultant force on a disc, N
    double max_unbalanced = 0.0;  ///< N
    double mean_contact = 0.0;    ///< mean force of touching pairs, N
    std::vector<Point> reaction;  ///< force of each surface on the discs, N
    double weight = 0.0;          ///< of all discs less the lift of their pushes, N
    std::int64_t touching = 0;    ///< pairs of discs

    double mean_ratio() const { return mean_contact > 0.0 ? mean_unbalanced / mean_contact : 0.0; }
    double max_ratio() const { return mean_contact > 0.0 ? max_unbalanced / mean_contact : 0.0; }
};

/// Forces as they stand, without advancing anything. `gravity` in m/s^2.
ForceBalance force_balance(const State& state, const RigidBase& base, double gravity);

/// Forces of a surface on the discs.
struct SurfaceLoad {
    Point force;      ///< on the discs, N
    int contacts = 0; ///< discs that touch it
};

/// Load of every surface of the base.
std::vector<SurfaceLoad> surface_loads(const State& state, const RigidBase& base);

/// Mean stress tensor of a disc, Pa, compression negative.
struct Stress {
    double xx = 0.0, yy = 0.0, xy = 0.0;
};

/// Stress of every disc: sum of force on it times arm to the contact, over its own area. Multiply
/// by the solid fraction for the stress of the rock.
std::vector<Stress> disc_stresses(const State& state, const RigidBase& base);

/// Number of touching discs and surfaces of every disc.
std::vector<int> coordination(const State& state, const RigidBase& base);

} // namespace listric::dem
