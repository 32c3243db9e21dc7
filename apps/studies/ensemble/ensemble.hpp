#pragma once

#include "apps/measures/polyline.hpp"
#include "apps/support/statistics.hpp"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

// Runs of one scene and several seeds, side by side on one section.

namespace listric {

/// A fault of a run's end.
struct EnsembleFault {
    measures::Polyline points; ///< from its upper to its lower end, m
    bool synthetic = true;     ///< dips the way the detachment does at the breakaway
};

/// The end of a finished run.
struct EnsembleRun {
    std::filesystem::path folder;
    int seed = 0;
    double extension = 0.0; ///< m
    std::vector<EnsembleFault> faults = {};
    std::vector<measures::Polyline> edges = {}; ///< of the blocks that moved as one, m
    /// Tops of strata by their number, 0 the pre-rift top: heights at columns of ensemble_column
    /// from x = 0 on, m; not finite where there is none.
    std::map<int, std::vector<double>> tops = {};
    std::map<std::string, double> measures = {}; ///< of summary.json
};

/// Runs that differ by their seeds alone.
struct Ensemble {
    std::string title; ///< its scene's name, or parameters in which that differs from others
    double length = 0.0, depth = 0.0;         ///< of the section, m
    measures::Polyline base = {};             ///< of the first run, m
    std::map<std::string, std::string> scene; ///< without the seed, to tell others from it
    std::vector<EnsembleRun> runs = {};
};

/// Columns in which tops are compared, and pieces of the section in which faults are counted, m.
inline constexpr double ensemble_column = 250.0, fault_piece = 1000.0;

/// The finished runs in a folder and two levels below, by scene. Throws UsageError if there is
/// none, SceneError, StorageError.
std::vector<Ensemble> read_ensembles(const std::filesystem::path& folder);

/// How many runs have a fault whose upper end lies in a piece of the section.
struct FaultChance {
    double x = 0.0; ///< middle of the piece, m
    int met = 0, of = 0;
    ProbabilityLimits limits;
};
std::vector<FaultChance> fault_chances(const Ensemble& ensemble);

/// A top over all runs, by column; only where half of them, and at least two, have it.
struct TopSpread {
    int stratum = 0;
    std::vector<double> x, mean, deviation; ///< m
};
std::vector<TopSpread> top_spreads(const Ensemble& ensemble);

/// Writes seeds.csv, seed-tops.csv, seed-measures.csv and draws seeds.png and seeds-apart.png in a
/// folder of runs; with `page` writes report.html, too. Returns the pictures and the page. Throws
/// UsageError, SceneError, StorageError.
std::vector<std::filesystem::path> draw_ensembles(const std::filesystem::path& folder, bool page);

/// Whether a folder holds runs in folders of their own, and is none itself.
bool holds_runs(const std::filesystem::path& folder);

} // namespace listric
