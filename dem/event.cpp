#include "dem/event.hpp"

#include "dem/numbers/round_off.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace listric::dem {

Event& add(Events& events, std::unique_ptr<Event> event) {
    const auto place = std::ranges::upper_bound(
        events, event->stage(), {}, [](const std::unique_ptr<Event>& e) { return e->stage(); });
    return **events.insert(place, std::move(event));
}

namespace {

/// Applications in a step.
std::int64_t parts_of(double step, double spacing, InSteps in_steps) {
    constexpr double round_off = 1e-9;
    std::int64_t parts = 1;
    if (in_steps == InSteps::as_travel_asks)
        while (step / static_cast<double>(parts) > spacing * (1.0 + round_off))
            parts *= 2;
    return parts;
}

} // namespace

Schedule::Schedule(double years, Calendar calendar, InSteps in_steps)
    : interval(years), calendar_(std::move(calendar)),
      spacing_(without_round_off(years * calendar_.rate())) {
    constexpr double round_off = 1e-9;
    if (calendar_.pauses().empty())
        return;
    rows_.push_back({Travel(), Travel(spacing_), 0});
    for (const SteppedPause& pause : calendar_.pauses()) {
        const Row& last = rows_.back();
        const auto until = static_cast<std::int64_t>(
            std::floor((pause.start - last.start).m / spacing_ + round_off));
        const std::int64_t parts = parts_of(pause.step.m, spacing_, in_steps);
        const std::int64_t before = last.before + until;
        rows_.push_back({pause.start, Travel(pause.step.m / static_cast<double>(parts)), before});
        rows_.push_back({pause.end(), Travel(spacing_), before + pause.steps * parts});
    }
}

Travel Schedule::due(std::int64_t n) const {
    if (rows_.empty())
        return Travel(static_cast<double>(n) * spacing_);
    auto row = std::ranges::lower_bound(rows_, n, {}, &Row::before);
    if (row != rows_.begin())
        --row;
    return row->start + static_cast<double>(n - row->before) * row->gap;
}

std::int64_t Schedule::nearest(Travel travel) const {
    if (rows_.empty())
        return std::llround(travel.m / spacing_);
    auto row = std::ranges::upper_bound(rows_, travel, {}, &Row::start);
    if (row != rows_.begin())
        --row;
    const std::int64_t before =
        row->before + static_cast<std::int64_t>((travel - row->start) / row->gap);
    return travel - due(before) < due(before + 1) - travel ? before : before + 1;
}

Travel Schedule::gap(std::int64_t n) const {
    return rows_.empty() ? Travel(spacing_) : due(n) - due(n - 1);
}

double Schedule::years(std::int64_t n) const {
    return rows_.empty() ? interval : calendar_.years(due(n - 1), due(n));
}

double Schedule::seconds(std::int64_t n) const { return years(n) * seconds_per_year; }

double Schedule::strain(double rate, std::int64_t n) const {
    return without_round_off(rate * seconds(n));
}

double Schedule::strain(double rate) const {
    return without_round_off(rate * (interval * seconds_per_year));
}

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
