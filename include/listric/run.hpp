#pragma once

/// Runs of scenes: load_scene() and Run, as `listric run` makes them. Link listric::run.

#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/model/effects.hpp"
#include "apps/run/driven_run.hpp"

#ifdef LISTRIC_INSTALLED_SHARE // defined by an installed listric::run
#include <cstdlib>

namespace listric {
/// Tells the library, which does not know where it lies, where scenes and rocks are.
inline const int share_is_told = setenv("LISTRIC_SHARE", LISTRIC_INSTALLED_SHARE, 0);
} // namespace listric
#endif
