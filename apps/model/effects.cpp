#include "apps/model/effects.hpp"

#include "apps/model/effect_list.hpp"

#include <array>

namespace listric {

EffectList program_effects() {
#define EFFECT(name) &effects::name::effect(),
    static const std::array list{LISTRIC_EFFECTS};
#undef EFFECT
    return list;
}

Works works_behind(std::string_view effect) {
#define EFFECT(name)                                                                               \
    if (effect == #name)                                                                           \
        return effects::name::works();
    LISTRIC_EFFECTS
#undef EFFECT
    return {};
}

} // namespace listric
