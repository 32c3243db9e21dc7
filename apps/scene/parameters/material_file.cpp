#include "apps/scene/parameters/material_file.hpp"

#include "apps/scene/toml/document.hpp"
#include "apps/scene/toml/pieces.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace listric {

using namespace dem;

namespace {

const Parameter description{
    "description", at<&RockMaterial::description>, "", {}, "", "what the material stands for"};

/// Reads a table that must say everything: a microproperty that was forgotten would silently be
/// another rock's.
void read_whole_table(const Entry& entry, const std::vector<Parameter>& parameters, void* object) {
    read_table(entry, parameters, object);
    for (const Parameter& p : parameters)
        if (must_be_said(p) && !entry.node.as_table()->contains(p.key))
            fail(entry, fmt::format("needs {} ({}; {})", p.key, p.doc, text(p.range)));
}

} // namespace

bool must_be_said(const Parameter& parameter) {
    constexpr std::string_view have_defaults[] = {"rolling_friction", "strength_is",
                                                  "permeability_law", "clay_fraction"};
    return std::ranges::find(have_defaults, parameter.key) == std::end(have_defaults);
}

RockMaterial read_material(const std::filesystem::path& file,
                           const std::vector<std::string>& changes) {
    toml::table document = read_document(materials, file);
    for (const std::string& change : changes)
        set(document, change, "--set " + change);
    RockMaterial rock;
    rock.name = file.stem().string();
    if (const std::string why = objection_to_name(rock.name); !why.empty())
        fail(fmt::format("{}:1: the file's name {}, and is the material's; rename the file",
                         file.string(), why));
    rock.material.bondable = false;
    bool has_material = false;
    for (const auto& [key, node] : document) {
        const Entry entry{node, std::string(key.str())};
        if (key == "description") {
            read(entry, description, &rock);
        } else if (key == "material") {
            read_whole_table(entry, material_parameters<>(), &rock.material);
            has_material = true;
        } else if (key == "bonds") {
            rock.bonds.emplace();
            rock.material.bondable = true;
            read_whole_table(entry, bond_parameters<>(), &*rock.bonds);
        } else if (key == "pores") {
            rock.pores.emplace();
            read_whole_table(entry, pore_parameters(), &*rock.pores);
        } else {
            fail(entry,
                 fmt::format("unknown {}, {}", node.is_table() ? "table" : "key",
                             advice(key.str(), {"description", "material", "bonds", "pores"})));
        }
    }
    if (!has_material)
        fail(fmt::format("{}: needs [material], the microproperties of its discs", file.string()));
    return rock;
}

void take_microproperties(Material& material, const RockMaterial& rock) {
    const bool bondable = material.bondable;
    material = rock.material;
    material.bondable = bondable;
}

RockMaterial load_material(const std::string& name_or_path,
                           const std::vector<std::string>& changes) {
    return read_material(materials.find(name_or_path), changes);
}

std::string to_toml(const RockMaterial& rock) {
    std::string lines = fmt::format("description = {}\n\n[material]\n{}", quoted(rock.description),
                                    write(material_parameters<>(), &rock.material));
    if (rock.bonds)
        lines += fmt::format("\n[bonds]\n{}", write(bond_parameters<>(), &*rock.bonds));
    if (rock.pores)
        lines += fmt::format("\n[pores]\n{}", write(pore_parameters(), &*rock.pores));
    return lines;
}

} // namespace listric
