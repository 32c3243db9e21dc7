#include "apps/run/forecast/prediction.hpp"

#include "apps/model/model.hpp"
#include "apps/run/genesis_cache.hpp"
#include "apps/support/machine/cores.hpp"
#include "apps/support/statistics.hpp"
#include "apps/support/stopwatch.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <system_error>

namespace listric {

using namespace dem;

namespace {

/// Hexagonal lattice on a floor, as many neighbours per disc as a settled packing has on average
/// once every third contact is left out by a gap.
struct Lattice {
    State state = empty_state();
    RigidBase base;
};

Lattice bonded_lattice(std::size_t discs) {
    const double radius = 100.0;
    const auto columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(discs) * 3.0)) + 1;
    Lattice lattice;
    State& state = lattice.state;
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
    const double width = 2.02 * radius * static_cast<double>(columns);
    lattice.base.surfaces = {
        {"floor", {line({-width, 0.0}, {2.0 * width, 0.0})}, 0.5, 0.0, {0.0, 0.0}}};
    state.clock.time_step = 0.1 * stable_time_step(d.mass[0], state.materials[0], 0.7, 1.0);
    sort_discs(state);
    find_contacts(state, lattice.base);
    const ContactColumns c = contact_columns(state);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        c.bonded[k] = 1;
        c.tensile_strength[k] = c.shear_strength[k] = 1e30f;
    }
    return lattice;
}

/// Time of a piece of cycles, s.
struct PieceTime {
    double quiet = 0.0; ///< by processor time
    double wall = 0.0;
};

/// Takes the quickest of the pieces of `seconds` by processor time, since a core that wakes up and
/// another program's moment only add to it; by the clock, the median in proportion.
PieceTime time_piece(Lattice& lattice, std::int64_t cycles, const Execution& execution,
                     double seconds) {
    const double sharing = execution.energy ? 1.0 : static_cast<double>(execution.threads);
    std::vector<double> quiet, wall;
    advance(lattice.state, lattice.base, {}, cycles / 4 + 1, execution); // packs it
    const auto start = SteadyClock::now();
    do {
        const auto piece_start = SteadyClock::now();
        const std::clock_t cpu_start = std::clock(); // of all threads
        advance(lattice.state, lattice.base, {}, cycles, execution);
        wall.push_back(seconds_since(piece_start));
        quiet.push_back(static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC / sharing);
    } while (seconds_since(start) < seconds);
    const double quickest = *std::ranges::min_element(quiet);
    return {quickest, quickest * median(wall) / median(quiet)};
}

} // namespace

/// More discs are as far from every cache, and their lattice would take longer than the answer may.
constexpr std::size_t most_probed = std::size_t{1} << 18;

CycleSpeed measure_speed(std::size_t discs, int threads, double seconds, bool accounted) {
    discs = std::min(discs, most_probed);
    Lattice lattice = bonded_lattice(discs);
    // So many that putting the state back after them does not count.
    const auto cycles = std::max<std::int64_t>(50, 1'000'000 / static_cast<std::int64_t>(discs));
    EnergyFlows flows;
    EnergyFlows* const account = accounted ? &flows : nullptr;
    Packed packed;
    const Execution team{threads, best_cycle(), account, &packed};
    const Execution alone{1, best_cycle(), account, &packed};
    const PieceTime of_team = time_piece(lattice, cycles, team, seconds);
    const PieceTime of_one =
        threads == 1 || accounted ? of_team : time_piece(lattice, cycles, alone, 0.5 * seconds);
    const double piece = static_cast<double>(cycles) * static_cast<double>(discs);
    return {.team = piece / of_team.quiet,
            .one_thread = piece / of_one.quiet,
            .busy = std::max(1.0, of_team.wall / of_team.quiet)};
}

namespace {

double price_of_genesis(const HangingWallParameters& h, double discs) {
    return discs * (run_prices.genesis + run_prices.genesis_crossing * h.thickness / h.mean_radius);
}

/// Windows of history and snapshots.
double price_of_windows(const Scene& s, const Workload& work) {
    return s.extension.distance / s.output.interval *
           (run_prices.window + run_prices.window_disc * work.discs);
}

/// Snapshots, one a window and no more than cycles.
double number_of_snapshots(const Scene& s, double cycles) {
    return 1.0 + std::min(std::ceil(s.extension.distance / s.output.interval), cycles);
}

/// Snapshots have a disc's columns and those of three contacts; the series has less.
/// Measured on a scene of 3,400 discs with all effects but an elastic base.
double disk_of_snapshot(const Scene& s, double discs) {
    const double series = s.output.series == SeriesFormat::paraview ? 5e3 + 93.0 * discs : 0.0;
    return 2e4 + 215.0 * discs + series;
}

/// Memory of the report for all moments until it is written, bytes.
double memory_of_report(const Scene& s, double snapshots, double discs) {
    return s.output.report ? std::min(most_of_report, snapshots * 25.0 * discs) : 0.0;
}

/// Samples of how quasi-static the run is, and contacts found anew after events.
double price_of_samples(const Scene& s, const Workload& work) {
    return s.extension.distance / run_prices.sample_spacing * run_prices.sample_disc * work.discs;
}

double price_of_effects(const Scene& s, const Workload& work) {
    double price = 0.0;
    for (const EffectPart& part : s.effects)
        if (part.effect->price)
            price += part.effect->price(s, work);
    return price;
}

double price_of_figures(const Scene& s, double discs, bool base_moves) {
    const double end = s.extension.distance;
    const auto before_end = static_cast<double>(std::ranges::count_if(
        s.output.figures, [&](double at) { return at < end - 0.5 * s.output.interval; }));
    return before_end * run_prices.early_figure_disc * discs + run_prices.figures +
           run_prices.figures_disc * discs + (base_moves ? run_prices.figures_of_moving_base : 0.0);
}

/// Discs that effects bring until the end.
std::size_t new_discs(const Scene& s) {
    double area = 0.0;
    for (const EffectPart& part : s.effects)
        if (part.effect->new_area)
            area += part.effect->new_area(s);
    return area > 0.0 ? disc_count(s.hanging_wall, area) : 0;
}

} // namespace

Prediction predict(const Scene& scene, const CycleSpeed& speed) {
    const HangingWallParameters& h = scene.hanging_wall;
    const double density = h.rock_density / (1.0 - packing_porosity);
    const double mean_mass = density * pi * h.mean_radius * h.mean_radius;
    const double smallest = 2.0 / (1.0 + h.radius_ratio);
    const ModelParts parts = make_parts(scene);
    double lightest = 1.0; // density of discs, over the hanging wall's
    for (const LayerFacts& layer : parts.layers)
        lightest = std::min(lightest, layer.rock.density / h.rock_density);
    if (parts.sediment)
        lightest = std::min(lightest, parts.sediment->disc_density / density);
    const double floor = scene.cycle.inertial_mass_floor > 0.0 ? scene.cycle.inertial_mass_floor
                                                               : lightest * smallest * smallest;
    Prediction p;
    p.time_step = stable_time_step(floor * mean_mass, parts.materials, scene.cycle.damping,
                                   scene.cycle.time_step_safety);
    p.discs_at_start = estimated_discs(scene);
    p.discs_at_end = p.discs_at_start + new_discs(scene);
    const double ramp = 0.5 * scene.extension.ramp; // s that it costs
    const double time = parts.base.motion.stages.empty()
                            ? scene.extension.distance / scene.extension.speed + ramp
                            : parts.base.motion.time_at(Travel(scene.extension.distance));
    p.cycles = std::floor(time / p.time_step);
    p.disc_steps = 0.5 * static_cast<double>(p.discs_at_start + p.discs_at_end) * p.cycles;
    const auto start = static_cast<double>(p.discs_at_start);
    const Workload work{.discs = 0.5 * (start + static_cast<double>(p.discs_at_end)),
                        .at_start = start,
                        .cycles = p.cycles,
                        .calendar = make_calendar(scene),
                        .travel = Travel(scene.extension.distance),
                        .area_ratio = h.radius_ratio * h.radius_ratio};
    // Threads share genesis and loops over discs about as well as the cycle. Measures, figures and
    // effects are counted as work of one: drop and roll is a chain.
    double shared = run_prices.cycle * p.disc_steps + price_of_genesis(h, start) +
                    price_of_samples(scene, work);
    const double figures = price_of_figures(scene, work.discs, parts.base_moves);
    const double windows = price_of_windows(scene, work);
    double serial = windows + price_of_effects(scene, work) + figures;
    if (start < run_prices.lists_shared_from)
        serial += run_prices.list_alone * p.disc_steps;
    else if (start < run_prices.lists_far_from)
        shared += run_prices.list_shared * p.disc_steps;
    else
        shared += run_prices.list_far * p.disc_steps;
    p.work = shared + serial;
    p.shared_work = shared;
    p.seconds = shared / speed.team + serial / speed.one_thread;
    p.forecast = {.before = price_of_genesis(h, start) / speed.team,
                  .after = figures / speed.one_thread,
                  .growth = static_cast<double>(p.discs_at_end) / start,
                  .windows = windows / speed.one_thread,
                  .window_share = scene.output.interval / scene.extension.speed / time,
                  .ramp_share = ramp / time};
    p.forecast.extension = p.seconds - p.forecast.before - p.forecast.after;
    // Columns of a disc, its listed contacts, and the neighbour search's copies.
    const double contacts =
        std::max(3.0, 0.42 * (2.0 + scene.cycle.skin) * (2.0 + scene.cycle.skin));
    p.memory =
        20e6 + static_cast<double>(p.discs_at_end) * (25 * 8.0 + contacts * 29.0 * 2.0 + 100.0);
    for (const EffectPart& part : scene.effects)
        if (part.effect->memory)
            p.memory += part.effect->memory(scene);
    p.snapshots = number_of_snapshots(scene, p.cycles);
    p.disk = p.snapshots * disk_of_snapshot(scene, work.discs);
    p.memory += memory_of_report(scene, p.snapshots, work.discs);
    return p;
}

Forecast forecast_now(const Scene& scene, double target, const RunOptions& options, int ranks) {
    const ModelParts parts = make_parts(scene);
    const int threads = options.threads;
    CycleSpeed speed = measure_speed(estimated_discs(scene), threads, 0.1, parts.accounts_energy);
    speed.team *= ranks;
    Scene to_target = scene;
    to_target.extension.distance = target;
    Forecast forecast = predict(to_target, speed).forecast;
    if (!options.figures)
        forecast.after = 0.0;
    std::error_code unreadable; // then the hanging wall is made anew
    if (std::filesystem::exists(genesis_cache_path(scene, parts), unreadable))
        forecast.before = 0.0;
    // Where the team leaves no core to them, pictures drawn beside the cycle take its time.
    if (options.figures && threads * ranks >= usable_cores()) {
        const Motion& motion = parts.base.motion;
        forecast.picture = run_prices.figure_beside / speed.one_thread;
        for (const double at : scene.output.figures)
            if (at < target - 0.5 * scene.output.interval)
                forecast.pictures.push_back(motion.time_at(Travel(at)) /
                                            motion.time_at(Travel(target)));
        forecast.extension += forecast.picture * static_cast<double>(forecast.pictures.size());
    }
    for (double* const part : {&forecast.before, &forecast.extension, &forecast.after,
                               &forecast.windows, &forecast.picture})
        *part *= speed.busy;
    return forecast;
}

} // namespace listric
