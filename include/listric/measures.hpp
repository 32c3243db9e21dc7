#pragma once

/// Measures of a section of moved points: faults, throws, rollover, depocentres. Link
/// listric::measures; it needs no run of this program.

#include "apps/measures/faults/fault_history.hpp"
#include "apps/measures/faults/fault_throw.hpp"
#include "apps/measures/faults/fault_trace.hpp"
#include "apps/measures/faults/moved_points.hpp"
#include "apps/measures/faults/shear_field.hpp"
#include "apps/measures/measures.hpp"
