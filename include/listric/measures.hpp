#pragma once

/// Measures of a section of moved points: faults, throws, rollover, depocentres. Link
/// listric::measures; it needs no run of this program.

#include "apps/measures/fault_history.hpp"
#include "apps/measures/fault_throw.hpp"
#include "apps/measures/fault_trace.hpp"
#include "apps/measures/measures.hpp"
#include "apps/measures/moved_points.hpp"
#include "apps/measures/shear_field.hpp"
