#include "apps/model/effects.hpp"
#include "apps/model/works.hpp"

#include <array>

// The program's effects, in the order in which tables, names and events of the same stage come.
// Each is described in effects/NAME.cpp.
// clang-format off
#define LISTRIC_EFFECTS \
    EFFECT(gravity) \
    EFFECT(bonds) \
    EFFECT(fault_weakening) \
    EFFECT(bond_healing) \
    EFFECT(sedimentation) \
    EFFECT(compaction) \
    EFFECT(energy) \
    EFFECT(elastic_base) \
    EFFECT(lower_crust_thinning) \
    EFFECT(basin_water) \
    EFFECT(footwall_erosion) \
    EFFECT(base_motion)
// clang-format on

namespace listric {

namespace effects {
#define EFFECT(name)                                                                               \
    const Effect& name();                                                                          \
    Works name##_works();
LISTRIC_EFFECTS
#undef EFFECT
} // namespace effects

EffectList program_effects() {
#define EFFECT(name) &effects::name(),
    static const std::array list{LISTRIC_EFFECTS};
#undef EFFECT
    return list;
}

Works works_behind(std::string_view effect) {
#define EFFECT(name)                                                                               \
    if (effect == #name)                                                                           \
        return effects::name##_works();
    LISTRIC_EFFECTS
#undef EFFECT
    return {};
}

} // namespace listric
