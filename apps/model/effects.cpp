#include "apps/model/effects.hpp"

#include "apps/model/effect_list.hpp"

#include <array>

namespace listric {

EffectList program_effects() {
#define EFFECT(name) &effects::name(),
    static const std::array list{LISTRIC_EFFECTS};
#undef EFFECT
    return list;
}

} // namespace listric
