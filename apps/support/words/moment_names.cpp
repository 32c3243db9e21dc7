#include "apps/support/words/moment_names.hpp"
#include "dem/numbers/elementary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace listric {

namespace {

constexpr int most_decimals = 15;

bool is_digits(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Five digits before the point at least.
std::string with_zeros(double extension, int decimals) {
    return fmt::format("{:0{}.{}f}", extension, 6 + decimals, decimals);
}

/// Without the zeros at the end of a number, down to some decimals.
std::string shortened(std::string text, std::size_t least) {
    const std::size_t shortest = text.find('.') + 1 + least;
    while (text.size() > shortest && text.ends_with('0'))
        text.pop_back();
    return text;
}

/// Decimals of a window's end; lengths in km.
int kilometre_decimals(double value, double interval) {
    for (int decimals = 1;; ++decimals) {
        const double unit = dem::power(10.0, -decimals);
        const double rest = std::abs(value - std::round(value / unit) * unit);
        const bool is_near = rest < std::min(0.05 * unit, 0.25 * interval);
        if (is_near || (decimals >= 2 && 0.5 * interval > unit) || decimals == most_decimals)
            return decimals;
    }
}

/// How many metres it has, and its name.
std::pair<double, const char*> unit_of(double length) {
    if (length >= 100.0 || length == 0.0)
        return {1e3, "km"};
    return length >= 0.1 ? std::pair(1.0, "m") : std::pair(1e-3, "mm");
}

} // namespace

int decimals_for(double step, int least) {
    int decimals = least;
    while (decimals < most_decimals && !(0.5 * step > dem::power(10.0, -decimals)))
        ++decimals;
    return decimals;
}

bool MomentNames::is_window_end(double extension) const {
    return std::ranges::binary_search(ends_, extension);
}

/// The round number that a moment is, with a cycle's error.
double MomentNames::asked_for(double extension) const {
    if (is_window_end(extension))
        return interval_ * std::round(extension / interval_);
    for (const double asked : asked_)
        if (std::abs(extension - asked) <= tolerance_)
            return asked;
    return extension;
}

std::string MomentNames::metres(double moment) const {
    const int decimals = decimals_for(interval_);
    const double extension = asked_for(moment);
    if (is_window_end(moment))
        return shortened(with_zeros(extension, decimals), 2);
    // The name of a window's end, those to come included, must be left to that.
    const double windows = extension / interval_;
    const auto is_taken = [&](const std::string& name) {
        const auto says = [&](double end) {
            return shortened(with_zeros(end, decimals), 2) == name;
        };
        return window_end(name) || says(interval_ * std::floor(windows)) ||
               says(interval_ * std::ceil(windows));
    };
    for (int more = decimals;; ++more)
        if (const std::string name = with_zeros(extension, more);
            !is_taken(name) || more == most_decimals)
            return name;
}

std::string MomentNames::kilometres(double extension) const {
    const double value = extension / 1e3, interval = interval_ / 1e3;
    const auto text_of = [](double km, int decimals) {
        return fmt::format("{:.{}f}", km, decimals);
    };
    const auto of_end = [&](double end) {
        return text_of(end / 1e3, kilometre_decimals(end / 1e3, interval));
    };
    const int decimals = kilometre_decimals(value, interval);
    if (is_window_end(extension))
        return text_of(value, decimals);
    const auto next = std::ranges::lower_bound(ends_, extension);
    std::vector<double> beside{interval_ * std::floor(extension / interval_),
                               interval_ * std::ceil(extension / interval_)};
    if (next != ends_.end())
        beside.push_back(*next);
    if (next != ends_.begin())
        beside.push_back(*(next - 1));
    for (int more = decimals;; ++more)
        if (const std::string name = text_of(value, more);
            more == most_decimals ||
            std::ranges::none_of(beside, [&](double end) { return of_end(end) == name; }))
            return name;
}

std::optional<double> MomentNames::window_end(std::string_view metres) const {
    const auto named = extension_of(metres);
    if (!named)
        return std::nullopt;
    const auto decimals = static_cast<int>(metres.size() - metres.find('.') - 1);
    const double half_a_unit = 0.5 * dem::power(10.0, -decimals) * (1.0 + 1e-6);
    // The nearest one: without its last zeros a name is coarser than the windows.
    const auto next = std::ranges::lower_bound(ends_, *named);
    std::optional<double> found;
    double least = half_a_unit;
    for (const auto end : {next == ends_.begin() ? next : next - 1, next})
        if (end != ends_.end())
            for (const double name : {asked_for(*end), *end})
                if (const double off = std::abs(name - *named); off <= least) {
                    least = off;
                    found = *end;
                }
    return found;
}

std::optional<double> extension_of(std::string_view metres) {
    const std::size_t point = metres.find('.');
    if (point == metres.npos || point < 5 || !is_digits(metres.substr(0, point)) ||
        !is_digits(metres.substr(point + 1)) || metres.size() - point < 3 ||
        (point > 5 && metres.front() == '0'))
        return std::nullopt;
    double value = 0.0;
    std::from_chars(metres.data(), metres.data() + metres.size(), value);
    return value;
}

bool is_kilometres(std::string_view text) {
    const std::size_t point = text.find('.');
    return point != text.npos && is_digits(text.substr(0, point)) &&
           is_digits(text.substr(point + 1)) && (point == 1 || text.front() != '0');
}

std::string way_text(double length, double of) {
    const auto [unit, name] = unit_of(of);
    return fmt::format("{:.2f} of {:.2f} {}", length / unit, of / unit, name);
}

std::string length_text(double length) {
    const auto [unit, name] = unit_of(std::abs(length));
    return fmt::format("{:.2f} {}", length / unit, name);
}

std::string length_text(double length, double interval) {
    return fmt::format("{:.{}f} m", length, decimals_for(interval));
}

} // namespace listric
