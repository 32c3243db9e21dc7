#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

namespace listric::dem {

// Hashes that tell whether two runs, files or requests are the same. They guard against accidents,
// not against people. Their values stand in snapshots and in tests: they may not change.

/// Mixes a word into a hash; the result's low half depends on all of both.
constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
    hash = std::rotl(hash ^ word, 23) * 0x9e3779b97f4a7c15u;
    return hash ^ (hash >> 32);
}

/// Adds a word to a hash of words in order: one to one in the word and in the hash.
constexpr std::uint64_t chained(std::uint64_t hash, std::uint64_t word) {
    return std::rotl(hash ^ word, 29) * 0x9e3779b97f4a7c15u;
}

/// Where fnv1a begins. It is the published number without its last digit; recorded hashes keep it.
inline constexpr std::uint64_t fnv1a_start = 1469598103934665603u;

/// FNV-1a [Fowler, Noll & Vo], a letter at a time.
constexpr std::uint64_t fnv1a(std::string_view text, std::uint64_t hash = fnv1a_start) {
    for (const char letter : text)
        hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211u;
    return hash;
}

/// Hashes a number at a time.
constexpr std::uint64_t fnv1a(std::span<const double> numbers, std::uint64_t hash = fnv1a_start) {
    for (const double number : numbers)
        hash = (hash ^ std::bit_cast<std::uint64_t>(number)) * 1099511628211u;
    return hash;
}

} // namespace listric::dem
