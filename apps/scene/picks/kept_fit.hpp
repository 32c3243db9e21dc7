#pragma once

#include "apps/scene/picks/fault_fit.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace listric {

/// fit_fault(), made once: what took long is kept in a file of the cache folder, and a file there
/// is believed if it holds these very points and this tolerance, is of this program, and its
/// detachment is as far from the points as it says. Without such a file the fit is made.
FaultFit fit_or_recall_fault(std::span<const dem::Point> points, double tolerance);

/// The fit as a file of the cache has it, with what it was made of; for tests.
std::string kept_text(const FaultFit& fit, std::span<const dem::Point> points, double tolerance);

/// Reads it back; none where the text is not of these points.
std::optional<FaultFit> recalled(std::string_view text, std::span<const dem::Point> points,
                                 double tolerance);

} // namespace listric
