#pragma once

#include "apps/support/named_numbers.hpp"
#include "dem/state.hpp"

#include <initializer_list>

namespace listric {

/// The footwall's measures over a run for summary.json, from its history and its end.
NamedNumbers footwall_summary(const dem::Table& history, const dem::State& state);

/// The last values of columns of the history.
NamedNumbers last_values(const dem::Table& history, std::initializer_list<const char*> columns);

} // namespace listric
