// LIS1 by the library dem at a geological rate, with faults alone or with healing and sediment:
//   drive RATE TRAVEL MEAN_RADIUS full|bare SEED
// prints the hash of the state every 500 m. Defaults in years and per second are turned to the rate
// as at_rate() in apps/scene/parameter.cpp does it.

#include <listric/dem.hpp>

#include "dem/round_off.hpp"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <string_view>

using namespace listric::dem;

namespace {

double rate;

double years(double usual) {
    if (rate == 0.01)
        return usual;
    const double metres = usual * 0.01, exact = metres / rate;
    const double rounded = without_round_off(exact);
    return without_round_off(rounded * rate) == without_round_off(metres) ? rounded : exact;
}

double per_second(double usual) {
    return rate == 0.01 ? usual : without_round_off(usual * (rate / 0.01));
}

} // namespace

int main(int, char** arguments) {
    rate = std::atof(arguments[1]);
    const double until = std::atof(arguments[2]);
    Model lis1{.hanging_wall = {.mean_radius = std::atof(arguments[3])},
               .detachment = {.segments = {arc_to_dip(0.0, 15e3), straight(60e3)}},
               .motion = {.speed = 1.25, .ramp = 24.0}};
    lis1.rate = rate;
    lis1.seed = static_cast<std::uint64_t>(std::atoi(arguments[5]));
    FaultWeakeningParameters& faults = lis1.fault_weakening.emplace();
    faults.material.friction = 0.2;
    faults.interval = years(faults.interval);
    faults.update_interval = years(faults.update_interval);
    faults.youngest_sediment = years(faults.youngest_sediment);
    faults.resting_rate = per_second(faults.resting_rate);
    if (std::string_view(arguments[4]) == "full") {
        BondHealingParameters& healing = lis1.bond_healing.emplace();
        healing.interval = years(healing.interval);
        healing.strain_rate = per_second(healing.strain_rate);
        lis1.sedimentation.emplace();
        lis1.sedimentation->interval = years(lis1.sedimentation->interval);
        lis1.compaction.emplace();
        lis1.compaction->interval = years(lis1.compaction->interval);
    }
    Simulation simulation = make_simulation(lis1);
    simulation.begin(make_hanging_wall(lis1));
    for (double at = 500.0; at < until + 1.0; at += 500.0) {
        simulation.extend_to(at, {.threads = 1});
        std::printf("%g m/a, %s, seed %s, %g m: %016" PRIx64 "\n", rate, arguments[4], arguments[5],
                    at, simulation.hash());
    }
}
