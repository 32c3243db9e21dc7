#include "coupling/thermal_load.hpp"

#include "coupling/interface_loads.hpp"
#include "dem/base/ground_level.hpp"
#include "dem/base/place.hpp"
#include "dem/base/target_line.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace listric::coupling {

using namespace dem;

namespace {

/// Column of the base's nodes: their uplift when the wall last moved, m.
constexpr const char* uplift_after_rift = "uplift_after_rift";
constexpr const char* of_film = "film"; // of the loads on the interface
constexpr const char *start_pressure = "at_start", *pressure_now = "pressure";

/// Whether the wall has moved on its way to a travel.
bool wall_moves(const Motion& motion, Travel travel) {
    constexpr double step = 1e-3; // m
    return motion.position(travel) != motion.position(travel - Travel(step));
}

} // namespace

std::vector<double> thermal_knots(double left, double right, double footwall_left,
                                  double footwall_right) {
    constexpr double spacing = 10e3, beyond = 100e3, most = 60.0; // m, m, intervals
    const double from = std::max(footwall_left, left - beyond);
    const double to = std::min(footwall_right, right + beyond);
    assert(from < to);
    const double parts = std::min(most, std::ceil((to - from) / spacing));
    std::vector<double> knots;
    for (double k = 0.0; k <= parts; ++k)
        knots.push_back(from + (to - from) * (k / parts));
    return knots;
}

ThermalLoad::ThermalLoad(std::vector<double> knots, std::vector<double> forces,
                         ThermalPressure pressure, const Schedule& schedule)
    : Event("thermal_load", schedule, dem::Stage::load), knots_(std::move(knots)),
      forces_(std::move(forces)), pressure_(std::move(pressure)) {
    assert(forces_.size() % knots_.size() == 0);
    memory.resize(knots_.size());
    std::ranges::copy(knots_, memory.add<double>("x", "m", 0.0).begin());
    memory.add<double>(start_pressure, "Pa", 0.0);
    memory.add<double>(pressure_now, "Pa", 0.0);
}

void ThermalLoad::begin(State& state) {
    footwall_load(state, name(), forces_.size() / knots_.size());
    state.base_nodes.add<double>(uplift_after_rift, "m", 0.0);
}

bool ThermalLoad::start(State&, const RigidBase&) {
    std::ranges::copy(pressure_(), memory.get<double>(start_pressure).begin());
    return false;
}

bool ThermalLoad::apply(State& state, const RigidBase& base) {
    std::ranges::transform(pressure_(), std::as_const(memory).get<double>(start_pressure),
                           memory.get<double>(pressure_now).begin(), std::minus());
    const std::vector<double> now = superpose(pressure(), forces_);
    std::ranges::copy(now, footwall_load(state, name(), now.size()).begin());
    if (wall_moves(base.motion, state.clock.travel))
        std::ranges::copy(base_node_columns(std::as_const(state)).uy,
                          state.base_nodes.get<double>(uplift_after_rift).begin());
    return false;
}

std::vector<double> ThermalLoad::pressure() const {
    const auto now = memory.get<double>(pressure_now);
    return {now.begin(), now.end()};
}

fem::Load ThermalLoad::load() const {
    return pressure_load(fem::Boundary::base, knots_, pressure());
}

double ThermalLoad::weight() const {
    const std::vector<double> now = pressure();
    double sum = 0.0;
    for (std::size_t k = 1; k < knots_.size(); ++k)
        sum += 0.5 * (now[k - 1] + now[k]) * (knots_[k] - knots_[k - 1]);
    return sum;
}

std::optional<double> post_rift_subsidence(const State& state, const Motion& motion, double x) {
    if (!state.base_nodes.has(uplift_after_rift))
        return std::nullopt;
    if (wall_moves(motion, state.clock.travel))
        return 0.0;
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    const auto before = state.base_nodes.get<double>(uplift_after_rift);
    std::vector<Point> sunk;
    for (std::size_t k = 0; k < nodes.x.size(); ++k)
        sunk.push_back({nodes.x[k], before[k] - nodes.uy[k]});
    return TargetLine(std::move(sunk)).height(x);
}

FootwallLoad thermal_load(const std::vector<double>& knots, const ThermalPressure& pressure,
                          const Schedule& schedule) {
    const auto make_event = [=](const LoadSolution& solution) {
        auto event = std::make_unique<ThermalLoad>(knots, solution.forces, pressure, schedule);
        ThermalLoad& heat = *event;
        return LoadingEvent{
            .event = std::move(event),
            .amounts = [&heat](const State&) { return heat.pressure(); },
            .load_elsewhere = [&heat](const State&) { return heat.load(); },
            .measures =
                [&heat](const State&) {
                    return NamedValues{{thermal_load_name, heat.weight()}};
                },
            .take_solution = [&heat](const LoadSolution& anew) { heat.take_forces(anew.forces); }};
    };
    return {pressure_loads(fem::Boundary::base, knots), make_event};
}

FilmColumns film_columns(const SedimentFilm& film, const State& state, const RigidBase& base,
                         double level, double column_width) {
    constexpr int samples = 4; // the smooth ground bends twice in a column
    FilmColumns columns;
    const auto now = film.now(state, base);
    if (!now)
        return columns;
    columns.porosity = now->porosity;
    const GroundLevel discs(state);
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    for (double left = 0.0; left < now->right; left += column_width) {
        double thickness = 0.0, wet = 0.0;
        for (int k = 0; k < samples; ++k) {
            const double x = left + (k + 0.5) / samples * column_width;
            const double ground = std::max(discs.height(x), height_at(nodes, x));
            const double here = now->thickness(x, ground);
            thickness += here / samples;
            wet += std::clamp(level - ground, 0.0, here) / samples;
        }
        columns.thickness.push_back(thickness);
        columns.wet.push_back(wet);
    }
    return columns;
}

FilmLoad::FilmLoad(const Interface& interface, const FilmLoadParameters& parameters)
    : Event(of_film, film_schedule(parameters.film), dem::Stage::load), parameters_(parameters),
      columns_(interface, parameters.column_width) {}

void FilmLoad::begin(State& state) { interface_load(state, name(), columns_.unknowns()); }

bool FilmLoad::apply(State& state, const RigidBase& base) {
    const double level = parameters_.level ? parameters_.level->at(state) : 0.0;
    const double displaced = parameters_.level ? parameters_.water_density : 0.0;
    const FilmColumns film =
        film_columns(parameters_.film, state, base, level, parameters_.column_width);
    std::vector<double> pressure;
    for (std::size_t k = 0; k < film.thickness.size(); ++k)
        pressure.push_back(
            (1.0 - film.porosity) * parameters_.gravity *
            (parameters_.grain_density * film.thickness[k] - displaced * film.wet[k]));
    columns_.put(state, name(), pressure);
    return false;
}

Schedule film_schedule(const SedimentFilm& film) {
    constexpr double furthest = 25.0; // m
    const Schedule& strata = film.deposition;
    return {strata.interval / std::ceil(strata.spacing() / furthest), strata.calendar()};
}

FootwallLoad film_load(const FilmLoadParameters& parameters) {
    return {{}, [parameters](const LoadSolution& solution) {
                return LoadingEvent{
                    .event = std::make_unique<FilmLoad>(solution.base.interface(), parameters),
                    .measures = [](const State& state) {
                        return NamedValues{{film_load_name, weight_on_interface(state, of_film)}};
                    }};
            }};
}

} // namespace listric::coupling
