#include "coupling/thermal_load.hpp"

#include "coupling/interface_loads.hpp"
#include "dem/base/target_line.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace listric::coupling {

using namespace dem;

namespace {

/// Column of the base's nodes: their uplift when the wall last moved, m.
constexpr const char* uplift_after_rift = "uplift_after_rift";
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

} // namespace listric::coupling
