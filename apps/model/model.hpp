#pragma once

#include "apps/scene/parameters/effect.hpp"

#include "coupling/footwall_loads.hpp"

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace listric {

/// Parts of a scene's model besides events: base, materials, physics, with every effect's share.
ModelParts make_parts(const Scene& scene);

/// The events of a scene, in the order in which they are applied at the same moment. An effect that
/// is not in the scene has no event, so it has no memory and no cost. Those of the loads on a base
/// that deforms come with its driver.
dem::Events make_events(const Scene& scene, const ModelParts& parts);

/// The loads on an elastic footwall, in the order in which they are applied. They refer to the
/// events of the run; where there are none, they stay as they are.
std::vector<coupling::FootwallLoad>
make_footwall_loads(const Scene& scene, const ModelParts& parts,
                    std::span<const std::unique_ptr<dem::Event>> events);

/// Driver of the base's nodes; null where none moves them. The events of the loads on the base are
/// appended to `loads`, for the run to apply: they, the driver and the run's other events refer to
/// each other.
/// @param events  of the run; none where only its states are looked at
std::unique_ptr<BaseDriver> make_base_driver(const Scene& scene, const ModelParts& parts,
                                             std::span<const std::unique_ptr<dem::Event>> events,
                                             std::vector<std::unique_ptr<dem::Event>>& loads);

/// Measures of effects, by their names.
struct EffectMeasures {
    NamedNumbers numbers = {};                                     ///< also columns of history.csv
    std::vector<std::pair<std::string, NamedNumbers>> groups = {}; ///< objects of summary.json
    std::vector<std::pair<std::string, std::vector<NamedNumbers>>> lists = {}; ///< of such objects
};

/// Measures of all effects that are on.
EffectMeasures measure_effects(const Observation& now);

/// Numbers of summary.json that follow from the columns that these effects have in history.csv.
NamedNumbers summarise_effects(const Scene& scene, const dem::Table& history);

/// The scene as far as the hanging wall before extension depends on it.
Scene genesis_of(const Scene& scene);

} // namespace listric
