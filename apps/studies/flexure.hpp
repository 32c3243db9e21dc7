#pragma once

#include "apps/run/options.hpp"
#include "apps/studies/flexure_plan.hpp"

#include <string>

namespace listric {

/// Bends the base of a plan and leaves summary.json, deflection.csv, footwall.pvd (displacement and
/// stress for ParaView) and figures/flexure.png in the output folder. Throws UsageError where no
/// footwall can be made, StorageError.
void run_flexure(const FlexurePlan& plan, const RunOptions& options);

/// The plate and its load, as text.
std::string explain(const FlexurePlan& plan);

} // namespace listric
