#pragma once

#include "dem/base/motion.hpp"
#include "dem/genesis/detachment.hpp"

#include <optional>

namespace listric {

struct Scene;

/// What a scene prescribes of its base's motion.
using PrescribedMotion = dem::BaseMotionParameters;

/// The base of a scene that has no detachment; none where it has one, or no base at all.
std::optional<dem::FlatBase> flat_base(const Scene& scene);

/// The fault of the basement that slips as a run goes on.
std::optional<dem::BasementFault> basement_fault(const Scene& scene);

} // namespace listric
