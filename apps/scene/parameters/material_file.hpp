#pragma once

#include "apps/scene/parameters/parameter.hpp"
#include "apps/scene/parameters/sediment_pores.hpp"
#include "apps/scene/toml/shelf.hpp"
#include "dem/material.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// Microproperties of a rock or sediment, from a file: `description`, [material] and, for rock
/// that can be bonded, [bonds], with the keys of the scene's tables of these names; for sediment
/// with pores of its own [pores].
struct RockMaterial {
    std::string name; ///< the file's, without folder and ending
    std::string description;
    dem::Material material; ///< bondable if it has bonds
    std::optional<dem::BondStrength> bonds;
    std::optional<SedimentPores> pores;
};

/// Stiffness and friction of a rock. Whether bonds heal stays as it is: that is up to the effects.
void take_microproperties(dem::Material& material, const RockMaterial& rock);

/// Where the program's materials are; the environment's LISTRIC_MATERIALS names another folder.
inline constexpr Shelf materials{"material", "a material has at least [material]",
                                 "LISTRIC_MATERIALS", "materials"};

/// Whether a material's file must give a parameter: all but resistance to rolling, the reading of
/// strengths and the law of permeability.
bool must_be_said(const Parameter& parameter);

/// Reads and checks a material, with changes such as "material.friction=1". Throws SceneError.
RockMaterial read_material(const std::filesystem::path& file,
                           const std::vector<std::string>& changes = {});

/// The material of a name in the materials folder, or of a path.
RockMaterial load_material(const std::string& name_or_path,
                           const std::vector<std::string>& changes = {});

/// The file that read_material reads back to the same material.
std::string to_toml(const RockMaterial& rock);

} // namespace listric
