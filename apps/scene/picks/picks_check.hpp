#pragma once

#include "apps/scene/picks/observed.hpp"
#include "apps/scene/scene.hpp"

#include <string>

namespace listric {

enum class PickKind { horizons, faults };

/// Refuses picks of a file that cannot be in the model of a scene: all of them above the original
/// surface, in another unit or beyond it; what is odd about some is a warning of the scene.
/// @param shift  that was added to every x, m
/// Throws SceneError with file and line.
void check_picks(Scene& scene, const PickedFile& picked, PickKind kind, double shift);

/// Why the ages of picks seem to be in another unit than years, with file and line; empty if they
/// do not. @param duration  of extension, a
std::string objection_to_ages(const PickedFile& picked, double duration);

} // namespace listric
