#pragma once

#include "apps/scene/scene_file.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

// What a page in which a scene is drawn asks of the program, as JSON: of `listric draw` while it
// writes the page, and of the model in the page (apps/page) from then on. All throw SceneError.

namespace listric {

/// The parameters in force of a scene that has been read, its warnings, and what it costs at every
/// accuracy, in disc-steps of the bare cycle.
nlohmann::ordered_json scene_facts(const Scene& scene);

/// The scene's document as it is written. Keys that did nothing are left out.
nlohmann::ordered_json scene_document(const SceneRequest& request, EffectList effects);

/// {value, fault}: what the scene has at "table.key" with the request's changes, and the first
/// fault that reading its values meets; empty: none.
nlohmann::ordered_json value_facts(const SceneRequest& request, const std::string& path,
                                   EffectList effects);

/// Start and pieces of a detachment, as keys of [detachment].
nlohmann::ordered_json pieces_json(const dem::DetachmentParameters& detachment);

/// Picked lines as the page keeps them: [{name, x_m, depth_m, age_a}].
nlohmann::ordered_json lines_json(const std::vector<PickedLine>& lines);

/// Points of the fault that a [detachment] names, shifted, as {x_m, depth_m}, and the pieces that
/// are fitted to them, or else why not, as {fault}.
nlohmann::ordered_json fitted_fault(const nlohmann::ordered_json& detachment, EffectList effects);

/// Refuses pieces that are no detachment.
void check_pieces(const nlohmann::ordered_json& detachment, EffectList effects);

/// What rigid footwall and slip alone predict for {detachment, extension_m, angle_deg, right_m,
/// reach_m}; curves have points every step_m or more, as whole numbers of unit_m.
nlohmann::ordered_json kinematics_json(const nlohmann::ordered_json& asked, EffectList effects);

} // namespace listric
