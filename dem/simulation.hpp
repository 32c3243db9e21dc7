#pragma once

#include "dem/base.hpp"
#include "dem/contacts/monitor.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/event.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace listric::dem {

class EnergyAccount;

/// A hanging wall that is extended: state and base, the cycle that moves them, and the events
/// between cycles. make_simulation() makes it of a Model; or build it, add events, begin, extend:
///
///     Simulation sandbox(make_halfgraben(...), {.gravity = 9.81});
///     sandbox.add<BondHealing>(...);
///     sandbox.begin(make_hanging_wall(...));
///     sandbox.extend_to(5e3);
///
/// An event is applied in the cycle nearest to the extension that it is due at; events due at the
/// same moment by their stages, and those of a stage in the order in which they were added. The
/// bits of the result depend neither on the threads nor on how the extension is cut into calls; but
/// an account of energy is booked at the end of every call, which may round its sums differently.
class Simulation {
public:
    /// The base's motion must have a speed.
    Simulation(RigidBase base, const CyclePhysics& physics);

    /// Adds an event; all events come before begin() or resume().
    Event& add(std::unique_ptr<Event> event);
    template <class E, class... Arguments> E& add(Arguments&&... arguments) {
        auto event = std::make_unique<E>(std::forward<Arguments>(arguments)...);
        E& added = *event;
        add(std::unique_ptr<Event>(std::move(event)));
        return added;
    }

    /// Advances state and base by cycles; `execution` says whether energies are added up.
    using Advance =
        std::function<void(State& state, const RigidBase& base, const CyclePhysics& physics,
                           std::int64_t cycles, const Execution& execution)>;

    /// Completes a state in which only the clock has been updated so far.
    using Collect = std::function<void(State& state)>;

    /// How cycles are made: advance() unless something else is asked for, such as a base that
    /// deforms. What it refers to must outlive the simulation.
    /// @param collect  called after cycles, before events and before extend_to() returns
    void advance_by(Advance advance, Collect collect = {}) {
        advance_ = std::move(advance);
        collect_ = std::move(collect);
    }
    void respond_by(BaseResponse& response);

    /// Greatest extension that the base is made for: extend_to() refuses to go beyond it.
    void end_at(Extension extension) { end_ = extension; }

    /// Told how long, s of wall time, a part of the work has taken: "cycle", "rebuild" (of the
    /// neighbour lists), or the event of that name.
    using TimeReport = std::function<void(const std::string& part, double seconds)>;
    void report_times_to(TimeReport report) { time_report_ = std::move(report); }

    /// Told while an event is applied that may take long, such as filling a deep basin. If it
    /// throws, the state is lost, and extend_to() throws the same.
    void report_steps_to(const StepReport& report);

    /// Starts with a hanging wall before extension. To be called once, after events were added.
    void begin(State state);

    /// Goes on with a state that such a simulation has reached before. Its events must have been
    /// given back their memories (Event::memory, Event::applied).
    void resume(State state);

    /// Told after every batch of cycles, a fraction of a second, when the clock is up to date. If
    /// it returns false, the simulation stops once due events are applied.
    using Report = std::function<bool(const Simulation&)>;

    /// Cycles and events up to a travel, m, to half a cycle: to that extension, where the motion
    /// has no stages. Returns false if the report has stopped it. Throws NumericalFailure, what
    /// events throw, and std::invalid_argument beyond end_at().
    bool extend_to(double travel, const Execution& execution = {}, const Report& report = {});

    Travel travel() const { return state_.clock.travel; }
    Extension extension() const { return state_.clock.extension; }
    Travel next_due() const;  ///< of the next event
    Travel tolerance() const; ///< half a cycle

    const State& state() const { return state_; }
    /// For what is no event, before the next cycles: keep contacts up to date.
    State& state() {
        touch();
        return state_;
    }
    const RigidBase& base() const { return base_; }
    const CyclePhysics& physics() const { return physics_; }
    std::span<const std::unique_ptr<Event>> events() const { return events_; }

    /// Columns of the state. They die with the next call that changes the simulation.
    ConstDiscColumns discs() const { return disc_columns(state_); }
    ConstContactColumns contacts() const { return contact_columns(state_); }

    ForceBalance force_balance() const {
        return dem::force_balance(state_, base_, physics_.gravity);
    }

    /// The first event that is an E; null if there is none.
    template <class E> const E* find() const { return dem::find<const E>(events_); }

    std::uint64_t hash() const { return dem::hash(state_, events_); }

    /// Discs times cycles since begin() or resume().
    double disc_steps() const { return disc_steps_; }

private:
    template <class Work> void timed(const std::string& part, Work&& work);
    void apply_due_events();
    void search_contacts();
    void touch();
    void cycle_toward(Travel goal, Execution execution);
    void collect();

    RigidBase base_;
    CyclePhysics physics_;
    State state_;
    Events events_;
    EnergyAccount* energy_ = nullptr; ///< one of the events, if it is on
    Advance advance_;
    Collect collect_;           ///< none: cycles leave nothing to collect
    Packed packed_;             ///< of the state
    bool is_untouched_ = false; ///< whether the state is as the last cycles left it
    TimeReport time_report_;
    double disc_steps_ = 0.0;
    Extension end_{std::numeric_limits<double>::infinity()};
    bool has_state_ = false;
};

} // namespace listric::dem
