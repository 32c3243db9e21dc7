#include "dem/simulation.hpp"

#include "dem/contacts/contacts.hpp"
#include "dem/events/energy_account.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace listric::dem {

namespace {

/// Cycles of a batch: a fraction of a second's work for these threads.
double greatest_batch(double discs, int threads) {
    return std::max(1.0, std::floor(2e7 * threads / discs));
}

} // namespace

Simulation::Simulation(RigidBase base, const CyclePhysics& physics)
    : base_(std::move(base)), physics_(physics),
      advance_([](State& s, const RigidBase& b, const CyclePhysics& p, std::int64_t cycles,
                  const Execution& how) { advance(s, b, p, cycles, how); }) {
    if (!(base_.motion.speed > 0.0 && base_.motion.greatest_speed() > 0.0))
        throw std::invalid_argument(
            "Simulation: Motion::speed is " + std::to_string(base_.motion.speed) +
            " m/s, and the greatest of its stages " +
            std::to_string(base_.motion.greatest_speed()) + "; both are above 0");
}

Event& Simulation::add(std::unique_ptr<Event> event) {
    assert(event && !has_state_);
    Event& added = dem::add(events_, std::move(event));
    energy_ = dem::find<EnergyAccount>(events_);
    return added;
}

void Simulation::respond_by(BaseResponse& response) {
    advance_by([&response](State& s, const RigidBase& b, const CyclePhysics& p, std::int64_t cycles,
                           const Execution& how) { advance(s, b, p, cycles, how, &response); });
}

void Simulation::report_steps_to(const StepReport& report) {
    for (const auto& event : events_)
        event->step_report = report;
}

void Simulation::begin(State state) {
    assert(!has_state_ && state.clock.cycle == 0);
    state_ = std::move(state);
    has_state_ = true;
    if (physics_.averaging_time > 0.0)
        add_mean_velocities(state_);
    for (const auto& event : events_)
        event->begin(state_);
    find_contacts(state_, base_);
    bool search_due = false;
    for (const auto& event : events_)
        search_due |= event->start(state_, base_);
    if (search_due)
        find_contacts(state_, base_);
    if (energy_)
        energy_->open(state_, base_);
    assert(is_valid(state_));
}

void Simulation::resume(State state) {
    assert(!has_state_ && is_valid(state));
    state_ = std::move(state);
    has_state_ = true;
}

bool Simulation::extend_to(double travel_in_metres, const Execution& execution,
                           const Report& report) {
    if (!has_state_)
        throw std::logic_error("Simulation::extend_to: there is no state; call begin() or resume() "
                               "before");
    const Travel goal(travel_in_metres);
    if (const Extension position = base_.motion.greatest_position(goal);
        position.m > end_.m + tolerance().m)
        throw std::invalid_argument("Simulation::extend_to: the extension would be " +
                                    std::to_string(position.m) + " m, but the base is made for " +
                                    std::to_string(end_.m) + " m; raise Model::distance");
    assert(!execution.energy); // that is EnergyAccount's
    const Team team(execution.threads);
    while (!has_come_to(travel(), goal, tolerance())) {
        const Travel stop = std::min(next_due(), goal);
        cycle_toward(stop, execution);
        const bool goes_on = !report || report(*this),
                   is_due = has_come_to(travel(), stop, tolerance());
        if (is_due || !goes_on)
            collect();
        if (is_due)
            apply_due_events();
        if (!goes_on)
            return false;
    }
    return true;
}

Travel Simulation::next_due() const {
    Travel due(std::numeric_limits<double>::infinity());
    for (const auto& event : events_)
        due = std::min(due, event->next_due());
    return due;
}

Travel Simulation::tolerance() const {
    return Travel(0.5 * base_.motion.greatest_speed() * state_.clock.time_step);
}

template <class Work> void Simulation::timed(const std::string& part, Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    if (time_report_)
        time_report_(
            part, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

/// Before the state is changed by anything but cycles.
void Simulation::touch() {
    packed_.forget();
    is_untouched_ = false;
}

void Simulation::search_contacts() {
    touch();
    timed("rebuild", [&] { find_contacts(state_, base_); });
}

/// Applies events and books them. An account sees contacts that an event has made, for they hold
/// energy; without one neighbours are searched once, after all events.
void Simulation::apply_due_events() {
    if (energy_)
        timed(energy_->name(), [&] { energy_->book_cycles(state_, base_); });
    bool search_due = false;
    for (const auto& event : events_) {
        if (event->next_due() > travel() + tolerance())
            continue;
        if (!dynamic_cast<const Observer*>(event.get()))
            touch();
        timed(event->name(), [&] { search_due |= event->apply(state_, base_); });
        ++event->applied;
        if (!energy_)
            continue;
        if (search_due)
            search_contacts();
        search_due = false;
        timed(energy_->name(), [&] { energy_->book_event(event->name(), state_, base_); });
    }
    if (search_due)
        search_contacts();
    assert(is_valid(state_));
}

void Simulation::collect() {
    if (collect_)
        timed("cycle", [&] { collect_(state_); });
}

/// Makes a batch of cycles, at most up to the goal.
void Simulation::cycle_toward(Travel goal, Execution execution) {
    const double per_cycle = base_.motion.greatest_speed() * state_.clock.time_step;
    const auto discs = static_cast<double>(state_.discs.rows());
    const auto batch =
        static_cast<std::int64_t>(std::clamp(std::floor((goal - travel()).m / per_cycle), 1.0,
                                             greatest_batch(discs, execution.threads)));
    EnergyFlows flows;
    if (energy_) {
        flows = energy_->flows();
        execution.energy = &flows;
    }
    execution.packed = &packed_;
    execution.state_is_untouched = std::exchange(is_untouched_, false); // until all has gone well
    timed("cycle", [&] { advance_(state_, base_, physics_, batch, execution); });
    is_untouched_ = true;
    if (energy_)
        energy_->put(flows);
    disc_steps_ += discs * static_cast<double>(batch);
}

} // namespace listric::dem
