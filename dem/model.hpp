#pragma once

#include "dem/events/bond_healing.hpp"
#include "dem/events/compaction.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/sedimentation.hpp"
#include "dem/genesis/detachment.hpp"
#include "dem/genesis/genesis.hpp"
#include "dem/numbers/units.hpp"
#include "dem/simulation.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

namespace listric::dem {

/// A hanging wall on a rigid detachment and its effects, each fact once. An effect is on where it
/// has parameters; the parameters of sediment and of weakened rock hold their material.
struct Model {
    HangingWallParameters hanging_wall = {};
    DetachmentParameters detachment = {};
    double distance = 10e3; ///< greatest extension, m: extend_to() goes no further
    /// Geological extension rate, m/a: the clock of all events. Their intervals and critical strain
    /// rates are for 0.01 by default; at another rate state those that stand for as many metres.
    double rate = 0.01;
    Motion motion = {.speed = 1.0, .ramp = 24.0};
    CyclePhysics physics = {.gravity = standard_gravity, .averaging_time = 150.0};
    Material basement = {};
    std::optional<BondStrength> bonds = BondStrength{};
    std::optional<BondHealingParameters> bond_healing = {}; ///< needs bonds
    std::optional<FaultWeakeningParameters> fault_weakening = {};
    std::optional<SedimentationParameters> sedimentation = {};
    std::optional<CompactionParameters> compaction = {}; ///< needs sedimentation
    std::uint64_t seed = 1;
};

/// Base, physics and events of a model. Add events of your own, then
/// begin(make_hanging_wall(model)). Throws std::invalid_argument if an effect lacks another.
Simulation make_simulation(const Model& model);

/// The hanging wall of a model before extension. Throws as make_simulation() does.
/// @param report  as that of make_hanging_wall(GenesisRequest)
State make_hanging_wall(const Model& model, int threads = 1,
                        const std::function<void(std::string_view, double)>& report = {});

} // namespace listric::dem
