#include "apps/model/effect_list.hpp"
#include "apps/scene/toml/pieces.hpp"

namespace listric::effects::bonds {

namespace {

/// Table [bonds].
struct RockBonds {
    dem::BondStrength strength;
};

} // namespace

Works works() { return {&works::itasca}; }

const Effect& effect() {
    static const Effect effect{
        .name = "bonds",
        .doc = "contact bonds that make rock of grains",
        .defaults = make_defaults<RockBonds>,
        .address = address_of<RockBonds>,
        .parameters = bond_parameters<&RockBonds::strength>(),
        .rock = RockSource{
            .key = "basement",
            .file = "mat18-b",
            .doc = "material, by name or path, with the defaults of [material] and [bonds]",
            .changes = "Sets stiffness, friction and strength of sound rock at once.",
            .take =
                [](Scene& scene, const RockMaterial& rock) {
                    if (rock.bonds)
                        scene.find<RockBonds>()->strength = *rock.bonds;
                },
            .objection = [](const RockMaterial& rock) -> std::string {
                return rock.bonds ? ""
                                  : "has no [bonds], but the scene does; add [bonds] to the "
                                    "material's file or take it out of the scene";
            },
        },
        .in_genesis = true,
        .contribute = [](const Scene& scene,
                         ModelParts& parts) { parts.bonds = scene.find<RockBonds>()->strength; },
    };
    return effect;
}

} // namespace listric::effects::bonds
