// Vectors of the compiler (gcc and clang). Every lane is computed as a scalar would be, so all
// widths give the same bits. One source serves them: `Lanes` is the widest that LISTRIC_LEVEL has
// in one register. The machine's own names stand for what vectors do not have (square root, any set
// lane) and where g++ 12 makes several instructions of one (conversions, rows and halves).
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
inline constexpr std::size_t rows_at_once = lane_count / 4; ///< rows of four numbers

inline Lanes load(const double* from) {
    Lanes v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

inline Lanes load(const float* from) {
#if LISTRIC_LEVEL >= 4
    return reinterpret_cast<Lanes>(_mm512_maskz_cvtps_pd(0xff, _mm256_loadu_ps(from)));
#elif LISTRIC_LEVEL >= 3
    return reinterpret_cast<Lanes>(_mm256_cvtps_pd(_mm_loadu_ps(from)));
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

/// Whether any lane is above the bound.
inline bool any_above(Lanes v, double bound) {
    const Lanes bounds = Lanes{} + bound;
#if LISTRIC_LEVEL >= 4
    return _mm512_cmp_pd_mask(reinterpret_cast<__m512d>(v), reinterpret_cast<__m512d>(bounds),
                              _CMP_GT_OQ) != 0;
#elif LISTRIC_LEVEL >= 3
    return _mm256_movemask_pd(reinterpret_cast<__m256d>(v > bounds)) != 0;
#else
    const Mask mask = v > bounds;
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

struct Lanes4 {
    Lanes a, b, c, d;
};

// Rows of four numbers, one row a lane, and columns of lanes. What moves between the halves of a
// register takes as long as three operations within them. Where four lanes are one register, rows
// are loaded by halves, those of rows k and k + 2 into one, so that columns come from moves within
// halves; where eight are, a disc is one register, and rows k and k + 4 of a column share one.

/// (a0, b0, a2, b2) of every four numbers.
inline Lanes even_numbers(Lanes a, Lanes b) {
#if LISTRIC_LEVEL >= 4
    return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
#else
    return __builtin_shufflevector(a, b, 0, 4, 2, 6);
#endif
}

/// (a1, b1, a3, b3)
inline Lanes odd_numbers(Lanes a, Lanes b) {
#if LISTRIC_LEVEL >= 4
    return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
#else
    return __builtin_shufflevector(a, b, 1, 5, 3, 7);
#endif
}

#if LISTRIC_LEVEL >= 4

inline Double4 first_half(Double8 v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }

/// First halves of two registers, and second ones. The compiler would permute both.
inline Double8 first_halves(Double8 a, Double8 b) {
    return reinterpret_cast<Double8>(_mm512_maskz_insertf64x4(
        0xff, reinterpret_cast<__m512d>(a), reinterpret_cast<__m256d>(first_half(b)), 1));
}
inline Double8 second_halves(Double8 a, Double8 b) {
    return reinterpret_cast<Double8>(_mm512_maskz_shuffle_f64x2(
        0xff, reinterpret_cast<__m512d>(a), reinterpret_cast<__m512d>(b), 0xee));
}

/// From rows to columns, or from columns to rows.
inline Lanes4 transpose(const Lanes (&r)[4]) {
    const Lanes even_ab = even_numbers(r[0], r[1]), odd_ab = odd_numbers(r[0], r[1]);
    const Lanes even_cd = even_numbers(r[2], r[3]), odd_cd = odd_numbers(r[2], r[3]);
    const auto first_pairs = [](Lanes a, Lanes b) {
        return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
    };
    const auto second_pairs = [](Lanes a, Lanes b) {
        return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
    };
    return {first_pairs(even_ab, even_cd), first_pairs(odd_ab, odd_cd),
            second_pairs(even_ab, even_cd), second_pairs(odd_ab, odd_cd)};
}

#else

/// First or second half of rows k and k + 2 at numbers + places[lane].
template <int half>
inline Double4 load_halves(const double* numbers, const std::uint32_t* places, int k) {
    const double* const one = numbers + places[k];
    const double* const other = numbers + places[k + 2];
#if LISTRIC_LEVEL >= 3
    // One is spread over the register by its load, the other lies in its place already.
    const auto spread = [](const double* from) {
        return _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(from));
    };
    return reinterpret_cast<Double4>(
        half == 0 ? _mm256_blend_pd(spread(other), _mm256_load_pd(one), 0b0011)
                  : _mm256_blend_pd(spread(one + 2), _mm256_load_pd(other), 0b1100));
#else
    Double4 both;
    std::memcpy(&both, one + 2 * half, sizeof both / 2);
    std::memcpy(reinterpret_cast<char*>(&both) + sizeof both / 2, other + 2 * half,
                sizeof both / 2);
    return both;
#endif
}

/// Stores (a, b) and (c, d) of lanes 0 and 2, or 1 and 3, as rows that are sixteen numbers apart.
inline void store_two(double* to, Double4 ab, Double4 cd) {
    store(to, __builtin_shufflevector(ab, cd, 0, 1, 4, 5));
    store(to + 16, __builtin_shufflevector(ab, cd, 2, 3, 6, 7));
}

#endif

#if LISTRIC_LEVEL >= 4

/// Columns of pairs of discs: places and velocities of the second less those of the first, radius
/// and spin of each.
struct PairColumns {
    Lanes dx, dy, radius_i, radius_j, dvx, dvy, spin_i, spin_j;
};

[[gnu::always_inline]] inline PairColumns
pair_columns(const double* discs, const std::uint32_t* first, const std::uint32_t* second) {
    Lanes rows[8];
    for (int k = 0; k < 8; ++k) {
        const Lanes i = load(discs + first[k]), j = load(discs + second[k]);
        // Places 2, 3, 6 and 7 are radii and spins in place of differences.
        rows[k] = reinterpret_cast<Lanes>(_mm512_mask_shuffle_pd(
            reinterpret_cast<__m512d>(j - i), 0b11001100, reinterpret_cast<__m512d>(i),
            reinterpret_cast<__m512d>(j), 0b00001100));
    }
    Lanes places[4], velocities[4];
    for (int k = 0; k < 4; ++k) {
        places[k] = first_halves(rows[k], rows[k + 4]);
        velocities[k] = second_halves(rows[k], rows[k + 4]);
    }
    const auto [dx, dy, radius_i, radius_j] = transpose(places);
    const auto [dvx, dvy, spin_i, spin_j] = transpose(velocities);
    return {dx, dy, radius_i, radius_j, dvx, dvy, spin_i, spin_j};
}

#else

/// Columns of pairs of rows, first and second: numbers 0 and 1 of the second less those of the
/// first, and the number `own` (2 or 3) of each.
template <int own>
[[gnu::always_inline]] inline Lanes4 pair_columns(const double* numbers, const std::uint32_t* first,
                                                  const std::uint32_t* second) {
    Lanes apart[2], own_i[2], own_j[2];
    for (int k = 0; k < 2; ++k) {
        apart[k] = load_halves<0>(numbers, second, k) - load_halves<0>(numbers, first, k);
        own_i[k] = load_halves<1>(numbers, first, k);
        own_j[k] = load_halves<1>(numbers, second, k);
    }
    const auto of_own = [](Lanes a, Lanes b) {
        return own == 2 ? even_numbers(a, b) : odd_numbers(a, b);
    };
    return {even_numbers(apart[0], apart[1]), odd_numbers(apart[0], apart[1]),
            of_own(own_i[0], own_i[1]), of_own(own_j[0], own_j[1])};
}

#endif

/// Stores columns as rows of four numbers, eight numbers apart: by stored_row().
inline void store_rows(double* to, const Lanes4& columns) {
#if LISTRIC_LEVEL >= 4
    const auto [a, b, c, d] = transpose({columns.a, columns.b, columns.c, columns.d});
    store(to, a);
    store(to + 8, b);
    store(to + 16, c);
    store(to + 24, d);
#else
    store_two(to, even_numbers(columns.a, columns.b), even_numbers(columns.c, columns.d));
    store_two(to + 8, odd_numbers(columns.a, columns.b), odd_numbers(columns.c, columns.d));
#endif
}
