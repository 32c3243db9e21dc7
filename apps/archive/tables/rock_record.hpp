#pragma once

#include "apps/scene/picks/rock_line.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>

namespace listric::archive {

// The names of a run's rocks are known when its scene is read, and are written down then: a record
// of values alone cannot tell which of two materials with equal numbers was meant.

/// As summary.json and status.json have them: a list of objects `of`, `name`, `changed`.
nlohmann::ordered_json rocks_json(const RockOrigins& origins);

/// Rocks that a run's folder names; none if an older program began the run.
std::optional<RockOrigins> recorded_rocks(const std::filesystem::path& output);

/// Rocks of a scene; where its file is a run's record those that were written down beside it.
std::optional<RockOrigins> known_rocks(const Scene& scene);

} // namespace listric::archive
