#pragma once

#include "apps/laboratory/pure_shear.hpp"
#include "apps/laboratory/report.hpp"
#include "apps/laboratory/request.hpp"

#include <vector>

namespace listric {

/// The rates at which slabs are stretched: one varies, the other has the standard value. The first
/// is the standard pair. Throws UsageError if a rate of the call is out of range.
std::vector<CriticalRates> sweep_rates(const LaboratoryRequest& request,
                                       const CriticalRates& standard);

/// Stretches slabs of the rock over critical rates and seeds, beside a biaxial test that tells how
/// faults should dip; writes slabs.csv and faults.csv. Slabs that are finished are not made again.
/// @param confining  stresses of the biaxial test, Pa
void report_pure_shear(LaboratoryReport& report, const LaboratoryRequest& request,
                       const std::vector<double>& confining);

} // namespace listric
