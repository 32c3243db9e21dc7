#pragma once

#include "apps/measures/run_so_far.hpp"

#include <string>

namespace listric {

class RunView;

// What is made once, where a run ends.

/// Adds the dilation of rock since a moment, the run's first, to its numbers.
void add_dilation(RunView& run, const measures::Past& start);

/// Compares picked horizons with the model's, if there are any.
void compare_picks(RunView& run);

/// The run's summary.json, with what has been added before.
std::string summary_of(RunView& run);

} // namespace listric
