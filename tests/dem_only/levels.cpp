// Prints the level of the cycle that this processor is given, and the hash of a small LIS1 at 100
// m: short enough for an emulator.

#include "dem/cycle/cycle_choice.hpp"

#include <listric/dem.hpp>

#include <cinttypes>
#include <cstdio>
#include <string>

using namespace listric::dem;

int main() {
    Model lis1{.hanging_wall = {.mean_radius = 800.0},
               .detachment = {.segments = {arc_to_dip(0.0, 15e3), straight(60e3)}},
               .motion = {.speed = 5.0, .ramp = 24.0}};
    lis1.bond_healing.emplace();
    lis1.fault_weakening.emplace().material.friction = 0.2;
    lis1.sedimentation.emplace();
    lis1.compaction.emplace();

    Simulation sandbox = make_simulation(lis1);
    sandbox.begin(make_hanging_wall(lis1));
    sandbox.extend_to(100.0);
    std::printf("%s %016" PRIx64 "\n", std::string(name(best_cycle())).c_str(), sandbox.hash());
}
