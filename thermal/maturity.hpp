#pragma once

#include <array>
#include <cstddef>

namespace listric::thermal {

// Vitrinite reflectance by EASY%Ro (Sweeney & Burnham 1990): twenty reactions of one frequency,
// each with an energy of its own, turn vitrinite into gas and carbon.

inline constexpr std::size_t reactions = 20;

/// Of each reaction the time integral of its rate: the natural logarithm of what it began with over
/// what is left. 0: fresh.
using Maturity = std::array<double, reactions>;

/// Adds a time, s, in which the temperature, degrees Celsius, goes evenly from one to another.
/// Simpson's rule over at most 10 K: within 2e-4 of %Ro.
void mature(Maturity& maturity, double from, double to, double seconds);

/// Vitrinite reflectance, %: 0.2019 fresh, 4.688 where all has reacted.
double vitrinite_reflectance(const Maturity& maturity);

} // namespace listric::thermal
