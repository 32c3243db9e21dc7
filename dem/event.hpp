#pragma once

#include "dem/base.hpp"
#include "dem/calendar.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace listric::dem {

/// How often something is applied in a step of a pause.
enum class InSteps {
    as_travel_asks, ///< once, or in as many halves of halves as keep its spacing: so what follows
                    ///< the discs' motion does, and of two such the rarer coincides with the other
    once
};

/// Geological time between applications, and the travel that it stands for: metres without
/// round-off, so that intervals of as many metres at different rates have equal bits. In pauses
/// that go by steps applications divide the steps, and each stands for the years since the last.
class Schedule {
public:
    double interval; ///< a, but in steps

    Schedule(double years, Calendar calendar, InSteps in_steps = InSteps::as_travel_asks);

    /// Once per this length of travel, whatever years that is.
    static Schedule every(double metres, const Calendar& calendar) {
        return {metres / calendar.rate(), Calendar(calendar.rate())};
    }

    const Calendar& calendar() const { return calendar_; }
    double spacing() const { return spacing_; } ///< m of travel, but in steps

    /// When it is applied for the nth time, counted from 1.
    Travel due(std::int64_t n) const;

    /// The application that is due nearest to a travel.
    std::int64_t nearest(Travel travel) const;

    // From the application before the nth to that:
    Travel gap(std::int64_t n) const;
    double years(std::int64_t n) const;
    double seconds(std::int64_t n) const; ///< of geological time
    /// Strain that a rate, 1/s, makes, without round-off.
    double strain(double rate, std::int64_t n) const;

    /// Strain that a rate, 1/s, makes in the interval, without round-off.
    double strain(double rate) const;

private:
    /// Applications at equal distances.
    struct Row {
        Travel start, gap;
        std::int64_t before; ///< applications up to the start
    };

    Calendar calendar_;
    double spacing_;
    std::vector<Row> rows_; ///< between pauses and in them, in turn; empty: one row for all
};

inline const Schedule never{std::numeric_limits<double>::infinity(), 1.0};

/// Told now and then how far something has come that may take long. It may throw to end it; what it
/// worked on is then left as it is.
using StepReport = std::function<void(const std::string& done)>;

/// Order of events that are due at the same travel.
enum class Stage {
    sample,  ///< looks at what the cycles have left
    adjust,  ///< radii and densities follow load and depth
    heal,    ///< bonds come
    weaken,  ///< faults are found
    deposit, ///< discs come and go
    account, ///< books what the others have done
    strain,  ///< a window starts with the discs that were deposited at its start
    load     ///< loads on the footwall
};

/// Something rare that happens to the state between cycles: an effect is one or more events.
///
/// Memory of an event per disc or contact is a column of the state; anything
/// else in its one table. Both are saved, resumed and hashed for it. Memory of where or how a disc
/// was begins, in discs that come later, as they are: Table::add_like().
class Event {
public:
    Event(std::string name, Schedule schedule, Stage stage = Stage::adjust)
        : name_(std::move(name)), schedule_(std::move(schedule)), stage_(stage) {}
    virtual ~Event() = default;

    const std::string& name() const { return name_; }
    const Schedule& schedule() const { return schedule_; }
    Stage stage() const { return stage_; }

    /// When it is to be applied next: ascending with `applied`, and of nothing else that changes.
    /// Once in the schedule's spacing, unless an event says otherwise.
    virtual Travel next_due() const { return schedule_.due(applied + 1); }

    /// Adds the event's columns to a state in which extension has not begun.
    virtual void begin(State&) {}

    /// Changes the state before the first cycle, once all events have added their columns and
    /// contacts are known. True if neighbours must be searched again.
    virtual bool start(State&, const RigidBase&) { return false; }

    /// Applies the event. True if neighbours must be searched again before the next cycle.
    virtual bool apply(State& state, const RigidBase& base) = 0;

    Table memory;
    std::int64_t applied = 0; ///< how often, since extension began
    StepReport step_report;   ///< of an application; none: nobody wants to know

private:
    std::string name_;
    Schedule schedule_;
    Stage stage_;
};

/// An event that only looks: nothing that a cycle depends on is other for it.
class Observer : public Event {
public:
    Observer(std::string name, Schedule schedule, Stage stage = Stage::sample)
        : Event(std::move(name), std::move(schedule), stage) {}

    /// Whether it can begin to look in the middle of a run.
    virtual bool begins_any_time() const { return false; }
};

/// Events in the order in which they are applied at the same travel.
using Events = std::vector<std::unique_ptr<Event>>;

/// Puts an event behind the events of its stage and of the stages before.
Event& add(Events& events, std::unique_ptr<Event> event);

/// The first of the events that is an E; null if there is none.
template <class E> E* find(std::span<const std::unique_ptr<Event>> events) {
    for (const auto& event : events)
        if (E* const found = dynamic_cast<E*>(event.get()))
            return found;
    return nullptr;
}

/// Hash of a state and of what events remember, from the hashes of their memories by name: equal
/// for equal runs.
std::uint64_t hash(const State& state, const std::map<std::string_view, std::uint64_t>& memories);
std::uint64_t hash(const State& state, std::span<const std::unique_ptr<Event>> events);

} // namespace listric::dem
