#pragma once

#include "apps/scene/scene_file.hpp"

namespace listric {

/// All effects that the program has (effect_list.hpp).
EffectList program_effects();

/// A scene of the program's effects. Throws SceneError.
inline Scene load_scene(const SceneRequest& request) {
    return load_scene(request, program_effects());
}

} // namespace listric
