#pragma once

/// Snapshots of runs: state, memory of events, history. Link listric::snapshot, which needs neither
/// TOML, JSON nor XML.

#include "apps/archive/snapshot/snapshot.hpp"
