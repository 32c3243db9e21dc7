#pragma once

#include "apps/measures/polyline.hpp"
#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <optional>
#include <span>
#include <vector>

namespace listric::measures {

// Edges of the blocks that a halfgraben leaves rigid: where rock stops moving as one. The main
// faults lie there, wherever their zones branch.

/// Which points followed the rigid motion of a core to `tolerance`, m. None unless two thirds of
/// the core did: then it is no block.
/// @param before, after  the points at two moments, m
/// @param core           by point: it belongs to the block's core
std::optional<std::vector<char>> followers(std::span<const dem::Point> before,
                                           std::span<const dem::Point> after,
                                           std::span<const char> core, double tolerance);

/// BlockSide of its edge on which a block lies.
enum class BlockSide { left, right };

/// The edge of a block, from top to bottom, y up: in every layer of the height `layer`, m, from
/// y = 0 down to `lowest` the x that leaves fewest points on the wrong side. Layers without edge
/// are left out.
/// @param points  m
/// @param inside  by point: it moved with the block
Polyline block_edge(std::span<const dem::Point> points, std::span<const char> inside,
                    BlockSide side, double layer, double lowest);

/// Height of the layers, m, for discs of a mean diameter, m.
double edge_layer(double diameter);

/// x where the parabola through an edge comes to a height, m.
double edge_at(const Polyline& edge, double y);

/// Edges since the start: of the outer block, then of the head block; what is no block has none.
/// Needs no earlier moment.
std::vector<Polyline> trace_block_edges(const RunSoFar& run);

/// Dip, bow, foot, shift and turn of the edges of the outer block (at the antithetic fault) and of
/// the head block (at the synthetic one).
/// @param rollover_tilt  of the head block, degrees; none: it is no block any more
NamedNumbers measure_block_edges(const RunSoFar& run, std::optional<double> rollover_tilt);

std::vector<Quantity> block_edge_quantities();

} // namespace listric::measures
