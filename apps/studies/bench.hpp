#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace listric {

/// Speed of the cycle on this machine, as one JSON object: discs contacts threads steps
/// disc_steps_per_s disc_steps_per_cpu_s. A packing file has one header line `n width top
/// kn_contact ks_contact mu density gravity` (SI) after comments, then n lines `x y r`; walls at
/// x = 0, x = width and y = 0. Without a file, a lattice of `discs` discs is made.
struct BenchRequest {
    std::filesystem::path packing;
    std::int64_t discs = 20000; ///< of the lattice, about
    std::int64_t steps = 1000;
    int threads = 1;
    bool bonded = true;
    bool plain = false;
};

/// Throws UsageError if the packing cannot be read.
std::string bench(const BenchRequest& request);

} // namespace listric
