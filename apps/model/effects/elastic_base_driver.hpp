#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <memory>
#include <span>
#include <vector>

namespace listric {

/// The elastic footwall of a run, with the loads of the scene's effects. Loads the plug-in. Throws
/// UsageError where no footwall can be made. See make_base_driver().
std::unique_ptr<BaseDriver>
make_elastic_base_driver(const Scene& scene, const ModelParts& parts,
                         std::span<const std::unique_ptr<dem::Event>> events,
                         std::vector<std::unique_ptr<dem::Event>>& loads);

} // namespace listric
