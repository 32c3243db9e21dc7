#pragma once

#include <span>
#include <string_view>

namespace listric::dem {

/// The plain cycle is the scalar specification of the fast one, which is compiled for three levels
/// of x86-64 processors: any, those with AVX2, and those with AVX-512. All give the same bits.
enum class Cycle { plain, baseline, v3, v4 };

std::string_view name(Cycle cycle);

/// Those that this processor can run, in their order.
std::span<const Cycle> cycles();

/// The fast cycle of the highest level.
Cycle fast_cycle();

/// The one that the environment variable LISTRIC_CYCLE names, or else the fastest. Throws
/// std::invalid_argument if this processor has none of that name.
Cycle best_cycle();

} // namespace listric::dem
