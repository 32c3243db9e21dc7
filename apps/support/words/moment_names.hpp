#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// Names of a run's moments in the names of its files. A window's end has as many
/// decimals as tell it from the next one; another moment, at which a run was stopped, has as many
/// as tell it from those.
class MomentNames {
public:
    MomentNames() = default;

    /// @param interval     between the ends of windows, m
    /// @param window_ends  that the run has come to, m, ascending
    MomentNames(double interval, std::span<const double> window_ends)
        : interval_(interval), ends_(window_ends.begin(), window_ends.end()) {}

    /// Names a moment after the one that was asked for, m, if a cycle has missed that by so much at
    /// most. The ends of windows are named after the multiples of the interval anyway.
    void name_after(double asked, double tolerance) {
        asked_.push_back(asked);
        tolerance_ = tolerance;
    }

    /// In metres, such as 00500.00.
    std::string metres(double extension) const;

    /// In kilometres, such as 0.5.
    std::string kilometres(double extension) const;

    bool is_window_end(double extension) const;

    /// The end of a window, m, that a name in metres is of; none if it is of none. Older versions
    /// named ends after the cycle, such as 00499.98.
    std::optional<double> window_end(std::string_view metres) const;

private:
    double asked_for(double extension) const;

    double interval_ = 100.0, tolerance_ = 0.0;
    std::vector<double> asked_;
    std::vector<double> ends_;
};

/// The extension, m, that a text says as MomentNames::metres() writes it; none if it does not.
std::optional<double> extension_of(std::string_view metres);

/// Whether MomentNames::kilometres() may write that.
bool is_kilometres(std::string_view text);

/// Decimals, at least `least`, with which numbers that lie half a step apart are told apart.
int decimals_for(double step, int least = 2);

/// A length on the way to another one, in the unit that suits that: "0.50 of 10.00 km".
std::string way_text(double length, double of);

/// A length, m, in the unit that suits it: "10.00 km".
std::string length_text(double length);

/// A length, m, with the decimals of an interval: "500.02 m".
std::string length_text(double length, double interval);

} // namespace listric
