#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace listric {

std::string text(double number) {
    // fmt turns to powers of ten only from 1e16 on, and 170000000000 is hard to read.
    if (std::abs(number) < 1e6 || !std::isfinite(number))
        return fmt::format("{}", number);
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                   std::chars_format::scientific)
                         .ptr;
    std::string text(buffer.data(), end);
    const auto sign = text.find("e+") + 1;
    text.erase(sign, text[sign + 1] == '0' ? 2 : 1); // 1.7e+11: 1.7e11, 2e+06: 2e6
    return text;
}

std::string rough_duration(double seconds) {
    const auto s = std::lround(std::min(seconds, 1e9));
    if (s < 90)
        return fmt::format("{} s", s);
    if (s < 570) {
        const auto tens = (s + 5) / 10;
        return tens % 6 == 0 ? fmt::format("{} min", tens / 6)
                             : fmt::format("{} min {} s", tens / 6, 10 * (tens % 6));
    }
    if (s < 5400)
        return fmt::format("{} min", (s + 30) / 60);
    return fmt::format("{:.1f} h", static_cast<double>(s) / 3600.0);
}

std::string ordinal(std::size_t number) {
    constexpr std::array<const char*, 11> words{"zeroth", "first", "second", "third",
                                                "fourth", "fifth", "sixth",  "seventh",
                                                "eighth", "ninth", "tenth"};
    if (number < words.size())
        return words[number];
    constexpr std::array<const char*, 4> endings{"th", "st", "nd", "rd"};
    const std::size_t last = number / 10 % 10 == 1 ? 0 : number % 10;
    return fmt::format("{}{}", number, endings[last < endings.size() ? last : 0]);
}

namespace {

std::string lower(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    return lower;
}

/// Damerau-Levenshtein distance in which no letter moves twice (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before.swap(above);
        above.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
    }
    return row[b.size()];
}

} // namespace

std::optional<std::string_view> nearest(std::string_view name,
                                        std::span<const std::string_view> candidates) {
    constexpr std::size_t longest = 64; // no name of ours is longer
    const std::string typed = lower(name.substr(0, longest));
    std::optional<std::string_view> best;
    std::size_t least = std::max<std::size_t>(1, typed.size() / 3) + 1;
    for (const std::string_view candidate : candidates) {
        // People forget the unit at the end, or the family in front: overpressure,
        // layer-overpressure.
        const bool lacks_unit = typed.size() > 2 && candidate.starts_with(typed + "_");
        const bool lacks_family = typed.size() > 2 && candidate.ends_with("-" + typed);
        const std::size_t distance = lacks_unit     ? 0
                                     : lacks_family ? 1
                                                    : edit_distance(typed, candidate);
        if (distance < least) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

std::string advice(std::string_view name, const std::vector<std::string_view>& allowed) {
    if (allowed.empty())
        return "none is allowed";
    const auto meant = nearest(name, allowed);
    return meant ? fmt::format("did you mean {}?", *meant)
                 : fmt::format("allowed: {}", fmt::join(allowed, ", "));
}

} // namespace listric
