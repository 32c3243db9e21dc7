#pragma once

namespace listric::dem {

// Elementary functions by additions, multiplications, divisions and square roots alone, which IEEE
// 754 rounds in one way: equal bits from every C library, compiler and processor. Each result is
// the exact one rounded to nearest, but where that lies within 2^-90 of itself of the middle
// between two numbers. Infinities, NaN and signed zeros are those of std. Some 0.2 to 1
// microseconds a call: not for the cycle.

double sine(double x);    ///< of radians, |x| below 2^52
double cosine(double x);  ///< of radians, |x| below 2^52
double tangent(double x); ///< of radians, |x| below 2^52
double arc_sine(double x);
double arc_tangent(double x);
double arc_tangent(double y, double x); ///< direction of (x, y), -pi to pi
double exponential(double x);
double exponential_less_one(double x);
double logarithm(double x);
double logarithm_of_one_and(double x); ///< of 1 + x
double logarithm_to_base_2(double x);
double logarithm_to_base_10(double x);
double power(double base, double exponent);

} // namespace listric::dem
