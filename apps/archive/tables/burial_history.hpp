#pragma once

#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/tables/line_table.hpp"

#include <filesystem>
#include <vector>

namespace listric::archive {

/// Places of wells: those at `wells`, x in m, or else the depocentre and, from there toward the
/// moving wall, the first place where sediment is half as thick; none where there is no sediment.
std::vector<WellPlace> well_places(const Observation& now, const std::vector<double>& wells);

/// Burial history of wells that are drilled at a moment of a run: a "line" for each stratum of
/// each, from the moment at which it was laid down; its points are the stratum's top. Empty where
/// the scene has no sediment, or none lies there.
/// @param drilled  a snapshot of the run
/// Throws StorageError.
LineTable burial_table(const RunFolder& run, const std::filesystem::path& drilled,
                       const std::vector<double>& wells);

} // namespace listric::archive
