#pragma once

#include <compare>

namespace listric::dem {

/// A length that is told by one of the two clocks of a run, or the difference of two such. Neither
/// becomes the other or a bare number by accident: Motion::position() leads from travel to
/// extension, nothing leads back.
template <class Which> struct ClockLength {
    double m = 0.0;

    constexpr ClockLength() = default;
    constexpr explicit ClockLength(double metres) : m(metres) {}

    friend constexpr auto operator<=>(ClockLength, ClockLength) = default;
    friend constexpr ClockLength operator+(ClockLength a, ClockLength b) {
        return ClockLength(a.m + b.m);
    }
    friend constexpr ClockLength operator-(ClockLength a, ClockLength b) {
        return ClockLength(a.m - b.m);
    }
    friend constexpr ClockLength operator*(double factor, ClockLength a) {
        return ClockLength(factor * a.m);
    }
    friend constexpr double operator/(ClockLength a, ClockLength b) { return a.m / b.m; }
};

/// Way of base and right wall, which ascends also while they rest or return: geological time at the
/// rate of extension. Ages, intervals and names of files go by it.
using Travel = ClockLength<struct TravelClock>;

/// Displacement of the right wall since the start: where things lie, and how much has been pulled.
using Extension = ClockLength<struct ExtensionClock>;

/// Whether a clock, which goes by cycles, has come to a moment that is asked for: to half a cycle.
template <class Which>
constexpr bool has_come_to(ClockLength<Which> now, ClockLength<Which> asked,
                           ClockLength<Which> half_a_cycle) {
    return now >= asked - half_a_cycle;
}

} // namespace listric::dem
