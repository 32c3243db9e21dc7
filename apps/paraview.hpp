#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"

#include <filesystem>

namespace listric {

/// Writes the discs (radius, material, stratum, velocity, stress, rotation) and contacts (bonded,
/// normal and shear force) of one moment as VTK PolyData into output/paraview, and the series
/// output/paraview.pvd over all moments there, with time in Ma. Opens in ParaView 5.11: show discs
/// as Point Gaussian or 2D Glyph, scaled by radius. Throws StorageError.
void write_paraview(const std::filesystem::path& output, const State& state, const RigidBase& base,
                    double extension_rate);

} // namespace listric
