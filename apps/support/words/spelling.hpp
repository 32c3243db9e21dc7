#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// The shortest text that reads back as the same number.
std::string text(double number);

/// A duration, s, as people say it: "80 s", "2 min 40 s", "12 min", "3.4 h".
std::string rough_duration(double seconds);

/// "second", "11th"
std::string ordinal(std::size_t number);

/// The candidate that a misspelt name most probably means, if any is close.
std::optional<std::string_view> nearest(std::string_view name,
                                        std::span<const std::string_view> candidates);

/// "did you mean mean_radius_m?", or else all that is allowed.
std::string advice(std::string_view name, const std::vector<std::string_view>& allowed);

} // namespace listric
