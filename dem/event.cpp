#include "dem/event.hpp"

#include "dem/numbers/round_off.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <bit>

namespace listric::dem {

Event& add(Events& events, std::unique_ptr<Event> event) {
    const auto place = std::ranges::upper_bound(
        events, event->stage(), {}, [](const std::unique_ptr<Event>& e) { return e->stage(); });
    return **events.insert(place, std::move(event));
}

Schedule::Schedule(double years, double metres_per_year)
    : interval(years), extension_rate(metres_per_year),
      spacing_(without_round_off(years * metres_per_year)) {}

double Schedule::seconds() const { return interval * seconds_per_year; }

double Schedule::strain(double rate) const { return without_round_off(rate * seconds()); }

std::uint64_t hash(const State& state, const std::map<std::string_view, std::uint64_t>& memories) {
    std::uint64_t h = hash(state);
    for (const auto& [name, memory] : memories)
        h = std::rotl(h ^ memory, 29) * 0x9e3779b97f4a7c15u;
    return h;
}

std::uint64_t hash(const State& state, std::span<const std::unique_ptr<Event>> events) {
    std::map<std::string_view, std::uint64_t> memories;
    for (const auto& event : events)
        memories[event->name()] = hash(event->memory);
    return hash(state, memories);
}

} // namespace listric::dem
