#pragma once

#include "apps/scene/scene.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace listric {

/// Bends the elastic base of a scene with [flexure] and leaves summary.json, deflection.csv,
/// footwall.pvd (displacement and stress for ParaView) and figures/flexure.png in `output`. Throws
/// UsageError where no footwall can be made, StorageError.
void bend_base(const Scene& scene, int threads, const std::filesystem::path& output,
               const std::function<void(const std::string&)>& say);

} // namespace listric
