#pragma once

#include "apps/laboratory/request.hpp"

#include <span>
#include <string_view>

namespace listric {

/// Their names.
std::span<const std::string_view> laboratory_tests();

/// Tests samples of a material; prints a table and leaves CSV files, summary.json and a figure in
/// the output folder. Throws UsageError, SceneError, NumericalFailure, StorageError, Interrupted.
void run_laboratory(const LaboratoryRequest& request);

/// Finds microproperties in the paper's sequence: stiffness, stiffness ratio, strengths, weakened
/// rock. Writes NAME.toml (and NAME-weak.toml), history.json with every evaluation, which --resume
/// reads back, and summary.json with the validation on seeds that the fit has not seen.
/// Throws UsageError, NumericalFailure, StorageError, Interrupted: what was measured is kept.
void run_calibration(const CalibrationRequest& request);

} // namespace listric
