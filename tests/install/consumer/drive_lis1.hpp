#pragma once

#include <listric/dem.hpp>

#include <cstdint>
#include <string_view>

constexpr int line_before = __LINE__;
/// LIS1 at draft accuracy to 500 m of extension, with all its effects. Returns the hash of the
/// state.
inline std::uint64_t drive_lis1(int threads) {
    using namespace listric::dem;
    const double rate = 0.01; // m/a: the clock of all events
    const HangingWallParameters wall{.mean_radius = 186.2};
    const CyclePhysics physics{.gravity = 9.81, .averaging_time = 150.0};
    const BondStrength bonds;
    FaultWeakeningParameters weakening;
    weakening.material.friction = 0.2; // mat18-w-frictional
    const SedimentationParameters filling;
    const RigidBase base = make_halfgraben({.segments = {arc_to_dip(0.0, 15e3), straight(60e3)}},
                                           {wall.length, wall.thickness, 10e3}, Material{},
                                           {.speed = 1.25, .ramp = 24.0});

    Simulation sandbox(base, physics);
    sandbox.add<Equilibrium>(2500.0, rate, physics.gravity);
    sandbox.add<SedimentStress>(500.0, 25.0, rate, physics);
    sandbox.add<PropertyUpdate>(weakening, rate, physics.gravity);
    sandbox.add<Compaction>(CompactionParameters{}, filling.surface_porosity, rate);
    sandbox.add<BondHealing>(BondHealingParameters{}, bonds, rate);
    sandbox.add<FaultWeakening>(weakening, rate, physics.gravity);
    sandbox.add<Sedimentation>(filling, wall.radius_ratio, rate);
    sandbox.add<Strain>(strain_window, rate);

    sandbox.begin(
        make_hanging_wall({.hanging_wall = wall,
                           .base = base,
                           .materials = {Material{}, filling.material, weakening.material},
                           .bonds = bonds,
                           .physics = physics},
                          [](std::string_view, double) {}));
    sandbox.extend_to(500.0, {.threads = threads});
    return sandbox.hash();
}
static_assert(__LINE__ - line_before - 1 <= 40);
