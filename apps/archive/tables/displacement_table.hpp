#pragma once

#include "apps/archive/tables/exports.hpp"
#include "apps/measures/faults/shear_field.hpp"

namespace listric::archive {

/// How far the ground has moved since an earlier moment, for models of landscapes: one line of
/// points one column apart, where they were then, with the displacement to the right (u_m) and
/// upward (w_m) of the discs that were uppermost and are still there; from_a and to_a are years
/// since extension began. No line where nothing is left.
/// @param before  places at the earlier moment
LineTable displacement_table(const ExportedMoment& at, const measures::DiscPlaces& before);

} // namespace listric::archive
