#include "dem/cycle/fast_cycle_kernels.hpp"

#include "dem/numbers/order_free.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#if defined __x86_64__
#include <immintrin.h>
#endif

// One source, compiled for each level. Names are local to a level, so that the linker cannot take
// the code of one for another. All headers come before: what they define inline is shared with the
// rest of the program, which runs on every processor. tests/checks/instructions.py looks at what
// came of it, and that nothing was fused to multiply-add, whose results differ.

namespace listric::dem::fast {

namespace baseline {
#define LISTRIC_LEVEL 1
#include "dem/cycle/fast_cycle_level.hpp"
#undef LISTRIC_LEVEL
} // namespace baseline

#if defined __x86_64__

#if defined __clang__
#pragma clang attribute push(__attribute__((target("avx2,bmi,bmi2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,bmi,bmi2")
#endif
namespace v3 {
#define LISTRIC_LEVEL 3
#include "dem/cycle/fast_cycle_level.hpp"
#undef LISTRIC_LEVEL
} // namespace v3
#if defined __clang__
#pragma clang attribute pop
#pragma clang attribute push(                                                                      \
    __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,bmi,bmi2"))), apply_to = function)
#else
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl")
#endif
namespace v4 {
#define LISTRIC_LEVEL 4
#include "dem/cycle/fast_cycle_level.hpp"
#undef LISTRIC_LEVEL
} // namespace v4
#if defined __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#endif

Kernels choose_kernels([[maybe_unused]] Cycle level, ContactLaw law, DampedAgainst motion,
                       bool has_ghosts) {
#if defined __x86_64__
    if (level == Cycle::v4)
        return v4::choose_kernels(law, motion, has_ghosts);
    if (level == Cycle::v3)
        return v3::choose_kernels(law, motion, has_ghosts);
#endif
    return baseline::choose_kernels(law, motion, has_ghosts);
}

} // namespace listric::dem::fast
