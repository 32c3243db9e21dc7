#pragma once

#include "apps/support/words/moment_names.hpp"
#include "dem/base.hpp"
#include "dem/calendar.hpp"
#include "dem/state.hpp"
#include "fem/footwall.hpp"

#include <filesystem>
#include <span>
#include <string>

namespace listric {

/// Writes one moment as VTK PolyData into output/paraview: discs (points: radius, material,
/// stratum, start depth, rotation, velocity, stress, coordination, bonds), contacts (lines: bonded,
/// normal and shear force, compression positive) and base (lines). The series output/paraview.pvd
/// holds those that are there of this moment and the ends of windows, with time in Myr;
/// docs/guides/paraview.md tells how to look at it.
/// @param names  of the run's moments
/// Throws StorageError.
void write_paraview(const std::filesystem::path& output, const dem::State& state,
                    const dem::RigidBase& base, const MomentNames& names,
                    const dem::Calendar& calendar);

/// Writes the footwall's present field, of that moment: a file in output/paraview, and the series
/// output/footwall.pvd of this moment and the ends of windows. Throws StorageError.
void write_footwall(const std::filesystem::path& output, const fem::Footwall& footwall,
                    double extension, const MomentNames& names, const dem::Calendar& calendar);

/// Writes output/paraview.py, which opens the series there in ParaView. Throws StorageError.
void copy_view(const std::filesystem::path& output);

/// Content of a DataArray of format "binary" in a VTK XML file with header_type UInt64 and
/// compressor vtkZLibDataCompressor: sizes, then the bytes, both in base64.
std::string vtk_array(std::span<const unsigned char> bytes);

} // namespace listric
