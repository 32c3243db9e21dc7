// Vectors of the compiler (gcc and clang). Every lane is computed as a scalar would be, so all
// widths give the same bits. One source serves them: `Lanes` is the widest that LISTRIC_LEVEL has
// in one register. Only the square root and the test for any set lane need the machine's own names.
// Text for fast_cycle_level.hpp.
using Double4 [[gnu::vector_size(32)]] = double;
using Double8 [[gnu::vector_size(64)]] = double;
using Float4 [[gnu::vector_size(16)]] = float;
using Float8 [[gnu::vector_size(32)]] = float;
using Mask4 [[gnu::vector_size(32)]] = std::int64_t;
using Mask8 [[gnu::vector_size(64)]] = std::int64_t;

#if LISTRIC_LEVEL >= 4
using Lanes = Double8;
using Mask = Mask8;
using FloatLanes = Float8;
#else
using Lanes = Double4;
using Mask = Mask4;
using FloatLanes = Float4;
#endif
inline constexpr int lane_count = sizeof(Lanes) / sizeof(double);

inline Lanes load(const double* from) {
    Lanes v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

inline Lanes load(const float* from) {
#if LISTRIC_LEVEL >= 4
    return reinterpret_cast<Lanes>(_mm512_maskz_cvtps_pd(0xff, _mm256_loadu_ps(from)));
#else
    FloatLanes v;
    std::memcpy(&v, from, sizeof v);
    return __builtin_convertvector(v, Lanes);
#endif
}

inline void store(double* to, Lanes v) { std::memcpy(to, &v, sizeof v); }

inline Lanes square_root(Lanes v) {
#if LISTRIC_LEVEL >= 4
    return reinterpret_cast<Lanes>(_mm512_maskz_sqrt_pd(0xff, reinterpret_cast<__m512d>(v)));
#elif LISTRIC_LEVEL >= 3
    return reinterpret_cast<Lanes>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(v)));
#else
    for (int lane = 0; lane < lane_count; ++lane)
        v[lane] = std::sqrt(v[lane]);
    return v;
#endif
}

inline bool any(Mask mask) {
#if LISTRIC_LEVEL >= 4
    const auto bits = reinterpret_cast<__m512i>(mask);
    return _mm512_test_epi64_mask(bits, bits) != 0;
#elif LISTRIC_LEVEL >= 3
    return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)) != 0;
#else
    std::int64_t all = 0;
    for (int lane = 0; lane < lane_count; ++lane)
        all |= mask[lane];
    return all != 0;
#endif
}

#if LISTRIC_LEVEL >= 4
inline Double8 magnitude(Double8 v) {
    return reinterpret_cast<Double8>(reinterpret_cast<Mask8>(v) &
                                     std::numeric_limits<std::int64_t>::max());
}
#endif

inline Double4 magnitude(Double4 v) {
    return reinterpret_cast<Double4>(reinterpret_cast<Mask4>(v) &
                                     std::numeric_limits<std::int64_t>::max());
}

// Rows of four numbers, one row a lane, and columns of lanes. Where eight lanes are one register,
// rows k and k + 4 share one, so that nothing moves between its halves; where four are, it holds
// row k.

#if LISTRIC_LEVEL >= 4

/// Register k of the rows at numbers + places[lane]. The compiler would load two rows and shuffle.
inline Double8 load_rows(const double* numbers, const std::uint32_t* places, int k) {
    return reinterpret_cast<Double8>(
        _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(_mm256_loadu_pd(numbers + places[k])),
                                 _mm256_loadu_pd(numbers + places[k + 4]), 1));
}

/// (a0, b0, a2, b2) of every row.
inline Double8 even_numbers(Double8 a, Double8 b) {
    return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
}
/// (a1, b1, a3, b3)
inline Double8 odd_numbers(Double8 a, Double8 b) {
    return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
}
/// (a0, a1, b0, b1)
inline Double8 first_halves(Double8 a, Double8 b) {
    return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
}
/// (a2, a3, b2, b3)
inline Double8 second_halves(Double8 a, Double8 b) {
    return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
}
/// (a0, a1, b2, b3)
inline Double8 first_and_second_half(Double8 a, Double8 b) {
    return __builtin_shufflevector(a, b, 0, 1, 10, 11, 4, 5, 14, 15);
}

#else

inline Double4 load_rows(const double* numbers, const std::uint32_t* places, int k) {
    return load(numbers + places[k]);
}

inline Double4 even_numbers(Double4 a, Double4 b) {
    return __builtin_shufflevector(a, b, 0, 4, 2, 6);
}
inline Double4 odd_numbers(Double4 a, Double4 b) {
    return __builtin_shufflevector(a, b, 1, 5, 3, 7);
}
inline Double4 first_halves(Double4 a, Double4 b) {
    return __builtin_shufflevector(a, b, 0, 1, 4, 5);
}
inline Double4 second_halves(Double4 a, Double4 b) {
    return __builtin_shufflevector(a, b, 2, 3, 6, 7);
}
inline Double4 first_and_second_half(Double4 a, Double4 b) {
    return __builtin_shufflevector(a, b, 0, 1, 6, 7);
}

#endif

struct Lanes4 {
    Lanes a, b, c, d;
};

/// From rows to columns, or from columns to rows.
inline Lanes4 transpose(const Lanes4& r) {
    const Lanes even_ab = even_numbers(r.a, r.b), odd_ab = odd_numbers(r.a, r.b);
    const Lanes even_cd = even_numbers(r.c, r.d), odd_cd = odd_numbers(r.c, r.d);
    return {first_halves(even_ab, even_cd), first_halves(odd_ab, odd_cd),
            second_halves(even_ab, even_cd), second_halves(odd_ab, odd_cd)};
}
