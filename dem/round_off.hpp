#pragma once

namespace listric::dem {

/// A number to twelve digits: what a short decimal number was before products and quotients left
/// their round-off in it. Values that are one and the same by two ways of reckoning get equal bits.
double without_round_off(double x);

} // namespace listric::dem
