#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <memory>
#include <vector>

namespace listric {

/// The elastic footwall of a run, with the loads of the scene's effects. Loads the plug-in. Appends
/// the events of the loads, for the run to apply, to `events`: they and the driver refer to each
/// other. Throws UsageError where no footwall can be made.
std::unique_ptr<BaseDriver>
make_elastic_base_driver(const Scene& scene, const ModelParts& parts,
                         std::vector<std::unique_ptr<dem::Event>>& events);

} // namespace listric
