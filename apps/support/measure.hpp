#pragma once

#include "apps/support/named_numbers.hpp"

#include <optional>
#include <string>
#include <string_view>

// How what is measured is declared: once, where it is taken. Files, documents, the report, Python
// and the check of plans follow from the declaration (archive/dictionary.hpp).

namespace listric {

/// How the values of history.csv become one of summary.json.
enum class OverTime {
    last,    ///< the newest
    largest, ///< by size
    mean,
    none ///< it is in history.csv alone
};

/// Name, unit, label and definition of a value in a file.
struct Quantity {
    std::string_view name;
    std::string_view unit;  ///< "1": a ratio or a count; none: no number
    std::string_view label; ///< a noun for people, in tables and charts
    std::string_view doc;
    OverTime over = OverTime::last;
    std::string_view usual = {}; ///< value of a good run, where documents give one
};

/// A quantity that is a number, and the function that takes it.
template <class Subject> struct Measure {
    std::string_view name, unit, label, doc;
    /// None: it has no meaning there. Not finite: it has one, but no value. Null: see who declares.
    std::optional<double> (*value)(const Subject& subject) = nullptr;
    OverTime over = OverTime::last;
    std::string_view usual = {}; ///< as that of a Quantity
    /// Words with which figures of tops against the regional say it, {} for its value in km; none:
    /// they do not.
    std::string_view said = {};

    constexpr Quantity quantity() const { return {name, unit, label, doc, over, usual}; }
};

inline void add(NamedNumbers& numbers, const Quantity& quantity, std::optional<double> value) {
    add(numbers, std::string(quantity.name), value);
}

/// Takes a member, or a member of that: taken<&Measures::cutoff, &Point::x>. What is behind an
/// optional may be missing.
template <auto First, auto... Rest> std::optional<double> taken(const auto& subject) {
    const auto& part = subject.*First;
    if constexpr (requires { part.has_value(); }) {
        if (!part)
            return std::nullopt;
        if constexpr (sizeof...(Rest) == 0)
            return static_cast<double>(*part);
        else
            return taken<Rest...>(*part);
    } else if constexpr (sizeof...(Rest) == 0) {
        return static_cast<double>(part);
    } else {
        return taken<Rest...>(part);
    }
}

} // namespace listric
