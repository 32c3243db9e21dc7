#pragma once

#include "dem/base.hpp"
#include "dem/base/trace.hpp"
#include "dem/state.hpp"

namespace listric::dem {

/// Where the base is: how far it has moved and how it is deformed.
struct BasePlace {
    double extension = 0.0;         ///< m
    std::span<const double> x, y;   ///< nodes without load, m; empty where the base is rigid
    std::span<const double> ux, uy; ///< their displacements, m

    Trace trace(const Surface& surface) const { return {x, y, ux, uy, surface.degree}; }
    bool deforms(const Surface& surface) const {
        return surface.follows != Follows::nothing && !x.empty();
    }
};

BasePlace base_place(const State& state);          ///< now
BasePlace searched_base_place(const State& state); ///< at the last search of all surfaces

/// Closest point of a surface.
std::optional<Foot> nearest(const Surface& surface, const BasePlace& place, Point p);

/// Whether a point is within a distance, m, of an open end of a surface.
bool is_near_end(const Surface& surface, const BasePlace& place, Point p, double distance);

/// The base as it stands, with chains of lines for what is deformed: for measuring and drawing.
RigidBase standing_base(const RigidBase& base, const State& state);

/// Height of the nodes as they have moved, at x, m: straight between them, level beyond the
/// first and the last. At least two nodes, x ascending.
double height_at(const ConstBaseNodeColumns& nodes, double x);

/// Greatest displacement of a node, m.
double greatest_node_displacement(const BasePlace& place);

/// Greatest distance of a node from where the last search of all surfaces found it, m.
double greatest_node_travel(const State& state);

/// Moves the nodes on by a time step with their velocities. Returns the largest component of one,
/// m/s.
double move_nodes(const BaseNodeColumns& nodes, double time_step);

} // namespace listric::dem
