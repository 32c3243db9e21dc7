#pragma once

/// Folders of runs: snapshots, scene, history, measures, and what is measured of them. Link
/// listric::archive.

#include "apps/archive/examine.hpp"
#include "apps/archive/run_folder.hpp"
#include "apps/archive/run_history.hpp"
#include "apps/archive/snapshot.hpp"
