#pragma once

/// Folders of runs: snapshots, scene, history, and measures of their moments. Link
/// listric::archive.

#include "apps/archive/examine.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/run_history.hpp"
#include "apps/archive/snapshot/snapshot.hpp"
