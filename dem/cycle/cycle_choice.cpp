#include "dem/cycle/cycle_choice.hpp"

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace listric::dem {

namespace {

constexpr std::array all{Cycle::plain, Cycle::baseline, Cycle::v3, Cycle::v4};
constexpr std::array<std::string_view, all.size()> names{"plain", "baseline", "v3", "v4"};

/// Level for which fast_cycle_kernels.cpp is compiled, by processor and system.
Cycle highest() {
#if defined __x86_64__
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
        __builtin_cpu_supports("bmi2"))
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                       __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")
                   ? Cycle::v4
                   : Cycle::v3;
#endif
    return Cycle::baseline;
}

Cycle cycle_named(std::string_view wanted) {
    std::string known;
    for (const Cycle cycle : cycles()) {
        if (name(cycle) == wanted)
            return cycle;
        known += (known.empty() ? "" : ", ") + std::string(name(cycle));
    }
    throw std::invalid_argument("LISTRIC_CYCLE: this processor has no cycle '" +
                                std::string(wanted) + "'; there are " + known);
}

} // namespace

std::string_view name(Cycle cycle) { return names[static_cast<std::size_t>(cycle)]; }

std::span<const Cycle> cycles() {
    static const Cycle last = highest();
    return std::span(all).first(static_cast<std::size_t>(last) + 1);
}

Cycle fast_cycle() { return cycles().back(); }

Cycle best_cycle() {
    static const Cycle best = [] {
        if (const char* wanted = std::getenv("LISTRIC_CYCLE"))
            return cycle_named(wanted);
#if defined __wasm_simd128__ // clang makes two registers of a vector
        return fast_cycle();
#else
        // Without AVX the compiler takes vectors apart, and the plain cycle is twice as fast.
        return fast_cycle() == Cycle::baseline ? Cycle::plain : fast_cycle();
#endif
    }();
    return best;
}

} // namespace listric::dem
