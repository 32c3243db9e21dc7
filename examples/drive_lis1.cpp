// LIS1 without a scene: its discs, events and cycles alone. Prints the hash of the state, which is
// the `state_hash` of `listric run lis1 --accuracy draft --until 500m`.

#include <listric/dem.hpp>

#include <cinttypes>
#include <cstdio>

using namespace listric::dem;

int main() {
    Model lis1{.hanging_wall = {.mean_radius = 186.2},
               .detachment = {.segments = {arc_to_dip(0.0, 15e3), straight(60e3)}},
               .motion = {.speed = 1.25, .ramp = 24.0}};
    lis1.bond_healing.emplace();
    lis1.fault_weakening.emplace().material.friction = 0.2;
    lis1.sedimentation.emplace();
    lis1.compaction.emplace();

    Simulation sandbox = make_simulation(lis1);
    sandbox.begin(make_hanging_wall(lis1));
    sandbox.extend_to(500.0, {.threads = 2});
    std::printf("%016" PRIx64 "\n", sandbox.hash());
}
