#pragma once

#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace listric::dem {

/// Purpose of a random number; keeps the streams of different purposes apart.
enum class Purpose : std::uint64_t {
    packing_place,
    packing_radius,
    bond_tension,
    bond_shear,
    deposition_place,
    deposition_radius,
    sweep_order,
};

/// Counter-based generator: a pure function of its key, so a number depends on what it is for and
/// not on how many were drawn before, in which order or on which thread. SplitMix64's finaliser
/// (Steele, Lea & Flood 2014, doi:10.1145/2714064.2660195) is chained over the key's words.
inline std::uint64_t random_bits(std::uint64_t seed, Purpose purpose, std::uint64_t a,
                                 std::uint64_t b = 0, std::uint64_t c = 0) {
    std::uint64_t h = 0;
    for (std::uint64_t word : {seed, static_cast<std::uint64_t>(purpose), a, b, c}) {
        h += word + 0x9e3779b97f4a7c15u;
        h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
        h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
        h ^= h >> 31;
    }
    return h;
}

/// Uniform in [0, 1).
inline double uniform(std::uint64_t seed, Purpose purpose, std::uint64_t a, std::uint64_t b = 0,
                      std::uint64_t c = 0) {
    return static_cast<double>(random_bits(seed, purpose, a, b, c) >> 11) * 0x1p-53;
}

/// Standard normal (Box-Muller), one number per key.
inline double normal(std::uint64_t seed, Purpose purpose, std::uint64_t a, std::uint64_t b = 0,
                     std::uint64_t c = 0) {
    const std::uint64_t bits = random_bits(seed, purpose, a, b, c);
    const double u = (static_cast<double>(bits >> 32) + 1.0) * 0x1p-32;
    const double v = static_cast<double>(bits & 0xffffffffu) * 0x1p-32;
    return std::sqrt(-2.0 * logarithm(u)) * cosine(2.0 * pi * v);
}

} // namespace listric::dem
