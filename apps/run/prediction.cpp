#include "apps/run/prediction.hpp"

#include "apps/model/effects.hpp"
#include "apps/support/stopwatch.hpp"
#include "dem/contacts.hpp"
#include "dem/cycle.hpp"
#include "dem/units.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace listric {

using namespace dem;

CycleSpeed measure_speed(std::size_t discs, int threads, double seconds, bool accounted) {
    // Hexagonal lattice on a floor, as many neighbours per disc as a settled packing has on average
    // once every third contact is left out by a gap.
    const double radius = 100.0;
    const auto columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(discs) * 3.0)) + 1;
    State state = empty_state();
    state.materials.assign(3, Material{});
    state.mean_radius = radius;
    state.skin = 0.25 * radius;
    add_discs(state, discs);
    DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < discs; ++i) {
        const std::size_t row = i / columns;
        d.x[i] = 2.02 * radius * (static_cast<double>(i % columns) + (row % 2 ? 0.5 : 0.0));
        d.y[i] = radius * (1.0 + 1.7 * static_cast<double>(row));
        d.radius[i] = radius;
        d.mass[i] = 3000.0 * pi * radius * radius;
    }
    RigidBase base;
    const double width = 2.02 * radius * static_cast<double>(columns);
    base.surfaces = {{"floor", {line({-width, 0.0}, {2.0 * width, 0.0})}, 0.5, 0.0, 0.0}};
    state.clock.time_step = 0.1 * stable_time_step(d.mass[0], state.materials[0], 0.7, 1.0);
    sort_discs(state);
    find_contacts(state, base);
    const ContactColumns c = contact_columns(state);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        c.bonded[k] = 1;
        c.tensile_strength[k] = c.shear_strength[k] = 1e30f;
    }
    // Long enough that packing the state for the fast cycle does not count.
    const auto batch = std::max<std::int64_t>(5, 4'000'000 / static_cast<std::int64_t>(discs));
    EnergyFlows flows;
    const Execution execution{threads, Cycle::best, accounted ? &flows : nullptr};
    advance(state, base, {}, batch / 4 + 1, execution);
    const auto start = SteadyClock::now();
    const std::clock_t cpu_start = std::clock(); // of all threads
    double cycles = 0.0;
    do {
        advance(state, base, {}, batch, execution);
        cycles += static_cast<double>(batch);
    } while (seconds_since(start) < seconds);
    const double wall = seconds_since(start);
    const double quiet = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC /
                         (accounted ? 1.0 : static_cast<double>(threads));
    return {cycles * static_cast<double>(discs) / quiet, std::max(1.0, wall / quiet)};
}

namespace {

// Prices in disc-steps of the bare cycle, so that they follow the machine's speed. Measured on
// lis1, rfr and lis1-elastic at draft and standard.

/// Contacts of a moving packing are listed anew more often than those of the lattice.
constexpr double cycle_price = 1.25;

/// Making the hanging wall. Settling takes as many cycles as waves need to cross it.
double price_of_genesis(const HangingWallParameters& h, double discs) {
    return discs * (30000.0 + 30.0 * h.thickness / h.mean_radius);
}

/// Events, and windows of history and snapshots.
double price_of_events(const Scene& s, double discs) {
    const double years = s.extension.distance / s.extension.rate;
    const double windows = s.extension.distance / s.output.interval;
    double price = windows * (1.1e7 + 600.0 * discs) + years / 2500.0 * 10.0 * discs;
    if (s.fault_weakening)
        price += years / s.fault_weakening->interval * 330.0 * discs +
                 years / s.fault_weakening->update_interval * 25.0 * discs;
    if (s.bond_healing)
        price += years / s.bond_healing->interval * 5.0 * discs;
    if (s.sedimentation)
        price += years / s.sedimentation->interval * (8e6 + 640.0 * discs);
    if (s.compaction)
        price += years / s.compaction->interval * 0.5 * discs;
    return price;
}

/// Pictures at the moments asked for and at the end, and the sheet with all moments.
double price_of_figures(const Scene& s, double discs) {
    const double end = s.extension.distance;
    const auto before_end = static_cast<double>(std::ranges::count_if(
        s.output.figures, [&](double at) { return at < end - 0.5 * s.output.interval; }));
    const bool of_base = s.elastic_base || s.base_motion;
    return (before_end + 1.0) * (2.6e8 + 3000.0 * discs) + (of_base ? 6e8 : 3e8);
}

/// Set-up, settling of the discs, and an answer every few cycles.
double price_of_elastic_base(const ElasticBaseParameters& b, double discs, double cycles) {
    return 5e7 + 1.2e4 * discs + 1350.0 * cycles / b.update_interval;
}

} // namespace

Prediction predict(const Scene& scene, double rate, int threads) {
    const HangingWallParameters& h = *scene.hanging_wall;
    const double density = h.rock_density / (1.0 - 0.166);
    const double mean_mass = density * pi * h.mean_radius * h.mean_radius;
    const double smallest = 2.0 / (1.0 + h.radius_ratio);
    const double floor = scene.cycle.inertial_mass_floor > 0.0 ? scene.cycle.inertial_mass_floor
                                                               : smallest * smallest;
    Prediction p;
    p.time_step = stable_time_step(floor * mean_mass, make_materials(scene), scene.cycle.damping,
                                   scene.cycle.time_step_safety);
    p.discs_at_start = estimated_discs(scene);
    p.discs_at_end = p.discs_at_start;
    // Sediment fills distance times thickness. With burial it shrinks, and small discs fill up to
    // the target: lis1 takes 1.85 times the discs of a packing of that area.
    if (scene.sedimentation)
        p.discs_at_end +=
            disc_count(h, scene.extension.distance * h.thickness * (scene.compaction ? 1.85 : 1.1));
    const double time =
        scene.extension.distance / scene.extension.speed + 0.5 * scene.extension.ramp;
    p.cycles = static_cast<std::int64_t>(time / p.time_step);
    p.disc_steps = 0.5 * static_cast<double>(p.discs_at_start + p.discs_at_end) *
                   static_cast<double>(p.cycles);
    const auto start = static_cast<double>(p.discs_at_start);
    const double mean_discs = 0.5 * (start + static_cast<double>(p.discs_at_end));
    // All but the cycle takes one thread.
    double serial = price_of_genesis(h, start) + price_of_events(scene, mean_discs) +
                    price_of_figures(scene, mean_discs);
    if (scene.elastic_base)
        serial += price_of_elastic_base(*scene.elastic_base, start, static_cast<double>(p.cycles));
    const double cycling_threads = scene.energy ? 1.0 : threads;
    p.seconds = (cycle_price * p.disc_steps + serial * cycling_threads) / rate;
    // Columns of a disc, three contacts each, and the neighbour search's copies.
    p.memory = 20e6 + static_cast<double>(p.discs_at_end) * (25 * 8.0 + 3 * 29.0 * 2.0 + 100.0);
    return p;
}

} // namespace listric
