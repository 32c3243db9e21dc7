#pragma once

#include "apps/model/works.hpp"
#include "apps/scene/parameters/effect.hpp"

// The program's effects, in the order in which tables, names and events of the same stage come.
// Each is described in effects/NAME.cpp.
// clang-format off
#define LISTRIC_EFFECTS \
    EFFECT(gravity) \
    EFFECT(bonds) \
    EFFECT(fault_weakening) \
    EFFECT(layer) \
    EFFECT(old_fault) \
    EFFECT(bond_healing) \
    EFFECT(sedimentation) \
    EFFECT(pore_fluid) \
    EFFECT(compaction) \
    EFFECT(bed) \
    EFFECT(heat) \
    EFFECT(energy) \
    EFFECT(elastic_base) \
    EFFECT(lower_crust_thinning) \
    EFFECT(basin_water) \
    EFFECT(footwall_erosion) \
    EFFECT(base_motion) \
    EFFECT(stage)
// clang-format on

#define EFFECT(name)                                                                               \
    namespace listric::effects::name {                                                             \
    const Effect& effect();                                                                        \
    Works works();                                                                                 \
    }
LISTRIC_EFFECTS
#undef EFFECT
