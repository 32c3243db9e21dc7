#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#if defined __SSE2__
#include <immintrin.h>
#endif

namespace listric {

// Vectors of the compiler (gcc and clang). Every lane is computed as a scalar would be, so all
// widths give the same bits. One source serves them: `Lanes` is the widest that the machine has in
// one register. Only the square root and the test for any set lane need the machine's own names.
using Double4 [[gnu::vector_size(32)]] = double;
using Double8 [[gnu::vector_size(64)]] = double;
using Float4 [[gnu::vector_size(16)]] = float;
using Float8 [[gnu::vector_size(32)]] = float;
using Mask4 [[gnu::vector_size(32)]] = std::int64_t;
using Mask8 [[gnu::vector_size(64)]] = std::int64_t;

#if defined __AVX512F__
using Lanes = Double8;
using Mask = Mask8;
using FloatLanes = Float8;
#else
using Lanes = Double4;
using Mask = Mask4;
using FloatLanes = Float4;
#endif
inline constexpr int lane_count = sizeof(Lanes) / sizeof(double);

/// Without AVX the compiler takes vectors apart, and the plain cycle is faster.
#if defined __AVX__
inline constexpr bool has_wide_registers = true;
#else
inline constexpr bool has_wide_registers = false;
#endif

inline Lanes load(const double* from) {
    Lanes v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

inline Lanes load(const float* from) {
    FloatLanes v;
    std::memcpy(&v, from, sizeof v);
    return __builtin_convertvector(v, Lanes);
}

inline void store(double* to, Lanes v) { std::memcpy(to, &v, sizeof v); }

inline Lanes square_root(Lanes v) {
#if defined __AVX512F__
    return reinterpret_cast<Lanes>(_mm512_maskz_sqrt_pd(0xff, reinterpret_cast<__m512d>(v)));
#elif defined __AVX__
    return reinterpret_cast<Lanes>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(v)));
#else
    for (int lane = 0; lane < lane_count; ++lane)
        v[lane] = std::sqrt(v[lane]);
    return v;
#endif
}

inline bool any(Mask mask) {
#if defined __AVX512F__
    const auto bits = reinterpret_cast<__m512i>(mask);
    return _mm512_test_epi64_mask(bits, bits) != 0;
#elif defined __AVX__
    return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)) != 0;
#else
    std::int64_t all = 0;
    for (int lane = 0; lane < lane_count; ++lane)
        all |= mask[lane];
    return all != 0;
#endif
}

#if defined __AVX512F__
inline Double8 magnitude(Double8 v) {
    return reinterpret_cast<Double8>(reinterpret_cast<Mask8>(v) &
                                     std::numeric_limits<std::int64_t>::max());
}
#endif

inline Double4 magnitude(Double4 v) {
    return reinterpret_cast<Double4>(reinterpret_cast<Mask4>(v) &
                                     std::numeric_limits<std::int64_t>::max());
}

/// Rows of four numbers, one row a lane, as four vectors of lanes.
struct Columns4 {
    Lanes a, b, c, d;
};

#if defined __AVX512F__

/// Rows k and k + 4 share a vector, so that what follows stays within 256 bits.
inline Columns4 transpose(const Double4 (&row)[8]) {
    const auto join = [&](int k) {
        return __builtin_shufflevector(row[k], row[k + 4], 0, 1, 2, 3, 4, 5, 6, 7);
    };
    const Double8 r0 = join(0), r1 = join(1), r2 = join(2), r3 = join(3);
    const Double8 even01 = __builtin_shufflevector(r0, r1, 0, 8, 2, 10, 4, 12, 6, 14);
    const Double8 odd01 = __builtin_shufflevector(r0, r1, 1, 9, 3, 11, 5, 13, 7, 15);
    const Double8 even23 = __builtin_shufflevector(r2, r3, 0, 8, 2, 10, 4, 12, 6, 14);
    const Double8 odd23 = __builtin_shufflevector(r2, r3, 1, 9, 3, 11, 5, 13, 7, 15);
    return {__builtin_shufflevector(even01, even23, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(odd01, odd23, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(even01, even23, 2, 3, 10, 11, 6, 7, 14, 15),
            __builtin_shufflevector(odd01, odd23, 2, 3, 10, 11, 6, 7, 14, 15)};
}

inline void transpose(const Columns4& columns, Double4 (&row)[8]) {
    const auto [a, b, c, d] = columns;
    const Double8 low_ab = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
    const Double8 high_ab = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    const Double8 low_cd = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
    const Double8 high_cd = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    const auto part = [&](int first, Double8 v) {
        row[first] = __builtin_shufflevector(v, v, 0, 1, 2, 3);
        row[first + 4] = __builtin_shufflevector(v, v, 4, 5, 6, 7);
    };
    part(0, __builtin_shufflevector(low_ab, low_cd, 0, 1, 8, 9, 4, 5, 12, 13));
    part(1, __builtin_shufflevector(high_ab, high_cd, 0, 1, 8, 9, 4, 5, 12, 13));
    part(2, __builtin_shufflevector(low_ab, low_cd, 2, 3, 10, 11, 6, 7, 14, 15));
    part(3, __builtin_shufflevector(high_ab, high_cd, 2, 3, 10, 11, 6, 7, 14, 15));
}

#else

inline Columns4 transpose(const Double4 (&row)[4]) {
    const Double4 even01 = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6);
    const Double4 odd01 = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7);
    const Double4 even23 = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6);
    const Double4 odd23 = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
    return {__builtin_shufflevector(even01, even23, 0, 1, 4, 5),
            __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5),
            __builtin_shufflevector(even01, even23, 2, 3, 6, 7),
            __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7)};
}

inline void transpose(const Columns4& columns, Double4 (&row)[4]) {
    const Double4 lines[4] = {columns.a, columns.b, columns.c, columns.d};
    const Columns4 rows = transpose(lines);
    row[0] = rows.a;
    row[1] = rows.b;
    row[2] = rows.c;
    row[3] = rows.d;
}

#endif

} // namespace listric
