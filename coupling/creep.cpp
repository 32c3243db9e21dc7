#include "coupling/creep.hpp"

#include "coupling/base_memory.hpp"
#include "coupling/interface_loads.hpp"
#include "dem/law.hpp"

#include <algorithm>
#include <cmath>

namespace listric::coupling {

using namespace dem;

namespace {

constexpr const char* creep_name = "creep";
constexpr double travel_of_a_step = 25.0; // m: as the lower crust's load
constexpr double round_off = 1e-6;        // m

/// Steps that differ by round-off of the calendar are one.
bool is_another(double step, double than) { return std::abs(step - than) > 1e-6 * than; }

} // namespace

Schedule creep_schedule(const Calendar& calendar) {
    return {travel_of_a_step / calendar.rate(), calendar};
}

Creep::Creep(fem::Footwall& footwall, ElasticBase& base, FootwallLoads& loads,
             const Calendar& calendar, Travel end)
    : Event(creep_name, creep_schedule(calendar), dem::Stage::load), footwall_(&footwall),
      base_(&base), loads_(&loads), end_(end), step_(schedule().seconds(1)) {}

void Creep::begin(State& state) {
    footwall_load(state, name(), base_->interface().unknowns());
    set_creep(state, {.step = step_,
                      .stress = std::vector<double>(3 * footwall_->stress_points().size(), 0.0),
                      .work = std::vector<double>(loads_->unit_loads(), 0.0)});
}

void Creep::take_step(double seconds) {
    footwall_->take_step(seconds);
    take_stiffness(*footwall_, *base_, *loads_);
    step_ = seconds;
}

void Creep::go_on_with(const State& state) {
    if (const double step = creep_step(state).value_or(step_); step != step_)
        take_step(step);
}

bool Creep::apply(State& state, const RigidBase&) {
    try {
        solve_for_field(*footwall_, *base_, *loads_, state);
        const bool is_last = schedule().due(applied + 1) + Travel(round_off) > end_;
        const double next = is_last ? step_ : schedule().seconds(applied + 2);
        const bool changes = is_another(next, step_);
        fem::Load left;
        left.stress = footwall_->stress_left(changes ? next : step_);
        if (changes) {
            take_step(next);
            base_->express(state);
            begin_means_anew(state);
            loads_->put(state);
        }
        put_stress_left(*footwall_, *base_, state, name(), std::move(left), step_);
    } catch (const fem::FootwallError& error) {
        throw NumericalFailure(std::string("elastic_base: the footwall cannot relax: ") +
                               error.what());
    }
    return false;
}

} // namespace listric::coupling
