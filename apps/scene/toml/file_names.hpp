#pragma once

#include "apps/scene/toml/tables.hpp"

#include <string>
#include <string_view>
#include <vector>

// Parameters that name files: of rocks, in [materials], and of effects.

namespace listric {

/// The object that such a parameter is of.
struct FileName {
    std::string file;
};

Parameter file_name(std::string_view key, std::string_view doc, std::string_view changes = {});

/// Where [material] has its defaults from.
inline constexpr RockSource basement_source{
    "basement", "mat18-b", "material, by name or path, with the defaults of [material] and [bonds]",
    "Sets stiffness, friction and strength of sound rock at once.",
    [](Scene& scene, const RockMaterial& rock) { take_microproperties(scene.basement, rock); }};

/// Rocks that [materials] can name, each key once.
std::vector<RockSource> rock_sources(EffectList effects);

/// Their parameters, of a FileName.
std::vector<Parameter> rock_file_names(EffectList effects);

/// Parameters of a table that name files and are no part of a scene, of a FileName.
std::vector<Parameter> file_names(const SceneTable& table);

} // namespace listric
