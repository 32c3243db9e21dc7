#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#if defined __SSE2__
#include <immintrin.h>
#endif

namespace listric {

// Vectors of the compiler (gcc and clang): eight lanes are one AVX-512 register, two of AVX2 or
// four of SSE2, and every lane is computed as a scalar would be. So one source serves all widths
// and all give the same bits. Only the square root and the test for any set lane need help.
using Double4 [[gnu::vector_size(32)]] = double;
using Double8 [[gnu::vector_size(64)]] = double;
using Float8 [[gnu::vector_size(32)]] = float;
using Mask4 [[gnu::vector_size(32)]] = std::int64_t;
using Mask8 [[gnu::vector_size(64)]] = std::int64_t;

inline Double8 widen(Float8 v) { return __builtin_convertvector(v, Double8); }

inline Double8 square_root(Double8 v) {
#if defined __AVX512F__
    return reinterpret_cast<Double8>(_mm512_sqrt_pd(reinterpret_cast<__m512d>(v)));
#else
    Double8 root;
    for (int lane = 0; lane < 8; ++lane)
        root[lane] = std::sqrt(v[lane]);
    return root;
#endif
}

inline bool any(Mask8 mask) {
#if defined __AVX512F__
    const auto bits = reinterpret_cast<__m512i>(mask);
    return _mm512_test_epi64_mask(bits, bits) != 0;
#else
    std::int64_t all = 0;
    for (int lane = 0; lane < 8; ++lane)
        all |= mask[lane];
    return all != 0;
#endif
}

inline Double8 magnitude(Double8 v) {
    return reinterpret_cast<Double8>(reinterpret_cast<Mask8>(v) &
                                     std::numeric_limits<std::int64_t>::max());
}

inline Double4 magnitude(Double4 v) {
    return reinterpret_cast<Double4>(reinterpret_cast<Mask4>(v) &
                                     std::numeric_limits<std::int64_t>::max());
}

/// Eight rows of four numbers to four columns of eight: rows k and k + 4 share a vector, so that
/// what follows stays within 256 bits.
struct Columns4 {
    Double8 a, b, c, d;
};

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

/// The inverse of the above.
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

} // namespace listric
