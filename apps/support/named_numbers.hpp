#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace listric {

/// Numbers by the names of docs/reference/measures.md, in the order in which they are shown. What
/// has no meaning is absent.
using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// Adds a number if it has a meaning: if there is one, and it is finite.
inline void add(NamedNumbers& numbers, std::string name, std::optional<double> value) {
    if (value && std::isfinite(*value))
        numbers.emplace_back(std::move(name), *value);
}

inline void append(NamedNumbers& numbers, const NamedNumbers& more) {
    numbers.insert(numbers.end(), more.begin(), more.end());
}

} // namespace listric
