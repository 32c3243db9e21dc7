#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"

#include <memory>
#include <span>
#include <string>

namespace listric::dem {

/// Geological time between applications, and the extension that it stands for.
struct Schedule {
    double interval = 0.0;       ///< a
    double extension_rate = 0.0; ///< m/a

    double spacing() const { return interval * extension_rate; } ///< m of extension
    double seconds() const;                                      ///< s of geological time
};

/// Something rare that happens to the state between cycles: an effect is one or more events.
///
/// What an event must remember per disc or contact it keeps in a column of the state; anything
/// else in its one table. Both are saved, resumed and hashed for it.
class Event {
public:
    Event(std::string name, Schedule schedule) : name_(std::move(name)), schedule_(schedule) {}
    virtual ~Event() = default;

    const std::string& name() const { return name_; }
    const Schedule& schedule() const { return schedule_; }

    /// Adds the event's columns to a state in which extension has not begun.
    virtual void begin(State&) {}

    /// Applies the event. True if neighbours must be searched again before the next cycle.
    virtual bool apply(State& state, const RigidBase& base) = 0;

    Table memory;
    std::int64_t applied = 0; ///< how often, since extension began

private:
    std::string name_;
    Schedule schedule_;
};

/// The first event of a type; null: there is none.
template <class E> const E* find(std::span<const std::unique_ptr<Event>> events) {
    for (const auto& event : events)
        if (const auto* found = dynamic_cast<const E*>(event.get()))
            return found;
    return nullptr;
}

} // namespace listric::dem
