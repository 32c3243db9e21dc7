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

} // namespace listric
