// The inner loops of the fast cycle. Text: fast_cycle_kernels.cpp includes it once for each level,
// in a namespace of its own, where LISTRIC_LEVEL is 1, 3 or 4.

namespace {

#include "dem/cycle/simd.hpp"

/// Asks for memory that is needed soon.
inline void prefetch(const void* start, std::size_t bytes) {
    for (std::size_t offset = 0; offset < bytes; offset += 64)
        __builtin_prefetch(static_cast<const char*>(start) + offset);
}

inline Double4 load_four(const void* from) {
    Double4 numbers;
    std::memcpy(&numbers, from, sizeof numbers);
    return numbers;
}

// Motion has a disc's four numbers in four lanes, of two discs where there are eight.

/// Four numbers for each disc.
inline Lanes for_each_disc(double a, double b, double c, double d) {
#if LISTRIC_LEVEL >= 4
    const Lanes numbers = {a, b, c, d, a, b, c, d};
#else
    const Lanes numbers = {a, b, c, d};
#endif
    return numbers;
}

/// Four numbers of each of the discs that lie in the lanes together.
inline Lanes of_discs(const Double4* each) {
#if LISTRIC_LEVEL >= 4
    return first_halves(__builtin_shufflevector(each[0], each[0], 0, 1, 2, 3, 0, 1, 2, 3),
                        __builtin_shufflevector(each[1], each[1], 0, 1, 2, 3, 0, 1, 2, 3));
#else
    return each[0];
#endif
}

struct MotionLanes {
    Lanes place, velocity;
};

inline MotionLanes load_motion(const Disc* discs) {
#if LISTRIC_LEVEL >= 4
    const double* const numbers = reinterpret_cast<const double*>(discs);
    const Lanes one = load(numbers), other = load(numbers + disc_numbers);
    return {first_halves(one, other), second_halves(one, other)};
#else
    return {load(discs->place), load(discs->velocity)};
#endif
}

inline void store_motion(Disc* discs, const MotionLanes& motion) {
#if LISTRIC_LEVEL >= 4
    double* const numbers = reinterpret_cast<double*>(discs);
    store(numbers, first_halves(motion.place, motion.velocity));
    store(numbers + disc_numbers, second_halves(motion.place, motion.velocity));
#else
    store(discs->place, motion.place);
    store(discs->velocity, motion.velocity);
#endif
}

/// Time step over inertia by number of a disc, 0 for the rate of its radius.
inline Lanes gain_of(Lanes inertia) {
#if LISTRIC_LEVEL >= 4
    return reinterpret_cast<Lanes>(
        _mm512_maskz_movedup_pd(0b01110111, reinterpret_cast<__m512d>(inertia)));
#else
    const Mask4 kept = {-1, -1, -1, 0};
    return reinterpret_cast<Lanes>(
        reinterpret_cast<Mask>(__builtin_shufflevector(inertia, inertia, 0, 0, 2, 2)) & kept);
#endif
}

inline Lanes weight_of(Lanes inertia) {
    const Lanes zero = {};
#if LISTRIC_LEVEL >= 4
    return __builtin_shufflevector(inertia, zero, 8, 1, 10, 11, 12, 5, 14, 15);
#else
    return __builtin_shufflevector(inertia, zero, 4, 1, 6, 7);
#endif
}

/// Mean velocity, m/s, with zeros where there is no mean. Converted by name: g++ 12 would store it
/// and load it again, which waits for the store.
inline Lanes mean_velocity([[maybe_unused]] const Inertia* discs, [[maybe_unused]] Lanes inertia) {
#if LISTRIC_LEVEL >= 4
    const __m512i last = {3, 3, 7, 7, 3, 3, 7, 7};
    const auto both = reinterpret_cast<Lanes>(
        _mm512_maskz_permutexvar_pd(0xff, last, reinterpret_cast<__m512d>(inertia)));
    return reinterpret_cast<Lanes>(
        _mm512_maskz_cvtps_pd(0b00110011, reinterpret_cast<__m256>(first_half(both))));
#elif LISTRIC_LEVEL >= 3
    const __m128i both = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(discs->mean_velocity));
    return reinterpret_cast<Lanes>(_mm256_zextpd128_pd256(_mm_cvtps_pd(_mm_castsi128_ps(both))));
#else
    const Lanes mean = {discs->mean_velocity[0], discs->mean_velocity[1], 0.0, 0.0};
    return mean;
#endif
}

/// -1 for each number of the discs that count.
inline Mask own_discs(const std::int64_t* own) {
#if LISTRIC_LEVEL >= 4
    const Mask mask = {own[0], own[0], own[0], own[0], own[1], own[1], own[1], own[1]};
#else
    const Mask mask = {own[0], own[0], own[0], own[0]};
#endif
    return mask;
}

/// Element `k`, or the end.
template <class Element> const Element* ahead(std::span<Element> elements, std::size_t k) {
    return elements.data() + std::min(k, elements.size());
}

/// Pairs of discs, as many as there are lanes, up to what takes longest: root and quotient.
struct Pairs {
    Lanes dx, dy, radius_i, radius_j;
#if LISTRIC_LEVEL >= 4
    Lanes dvx, dvy, spin_i, spin_j; // four lanes load them late, for lack of registers
#endif
    Lanes square, distance, inverse;
};

[[gnu::always_inline]] inline Pairs pairs_of(const Block& block, int start, const double* discs) {
#if LISTRIC_LEVEL >= 4
    const auto [dx, dy, radius_i, radius_j, dvx, dvy, spin_i, spin_j] =
        pair_columns(discs, block.first + start, block.second + start);
#else
    const auto [dx, dy, radius_i, radius_j] =
        pair_columns<3>(discs, block.first + start, block.second + start);
#endif
    const Lanes square = dx * dx + dy * dy;
    const Lanes distance = square_root(square);
    const Lanes inverse = 1.0 / distance;
#if LISTRIC_LEVEL >= 4
    return {dx, dy, radius_i, radius_j, dvx, dvy, spin_i, spin_j, square, distance, inverse};
#else
    return {dx, dy, radius_i, radius_j, square, distance, inverse};
#endif
}

/// The contact law of law.hpp and plain_cycle.cpp.
template <ContactLaw law>
[[gnu::always_inline]] inline void compute(Block& block, int start, const Pairs& pairs,
                                           [[maybe_unused]] const double* discs, Slot* slots,
                                           [[maybe_unused]] Rolling* rolling) {
    constexpr bool shears = law.bonded || law.frictional;
#if LISTRIC_LEVEL >= 4
    const auto [dx, dy, radius_i, radius_j, dvx, dvy, spin_i, spin_j, square, distance, inverse] =
        pairs;
#else
    const auto [dx, dy, radius_i, radius_j, square, distance, inverse] = pairs;
#endif
    const Lanes reach = radius_i + radius_j;
    const Lanes nx = dx * inverse, ny = dy * inverse;
    const Lanes overlap = reach - distance;
    const Lanes half = 0.5 * overlap;
    const Lanes arm_i = radius_i - half, arm_j = radius_j - half;
    const Lanes elastic = load(block.normal_stiffness + start) * overlap;
    const Lanes zero = {};
    // An overlap that is rounded to 0 needs no question: its forces are 0.
    const Mask pressed = square < reach * reach;

    Mask holds = {}; // the bond
    Lanes shear = zero;
    [[maybe_unused]] Lanes moment = zero; // against rolling
    if constexpr (shears) {
#if LISTRIC_LEVEL < 4
        const auto [dvx, dvy, spin_i, spin_j] =
            pair_columns<2>(discs + 4, block.first + start, block.second + start);
#endif
        const Lanes slip_rate = dvy * nx - dvx * ny - (arm_i * spin_i + arm_j * spin_j);
        const Lanes stuck = load(block.shear_force + start) -
                            load(block.shear_stiffness_times_step + start) * slip_rate;
        if constexpr (law.frictional) {
            const Lanes limit = load(block.friction + start) * elastic;
            const Lanes raised = stuck < -limit ? -limit : stuck;
            const Lanes clipped = limit < raised ? limit : raised;
            shear = (pressed & (limit > zero)) ? clipped : zero;
        }
        if constexpr (law.bonded) {
            const Lanes tensile_strength = load(block.tensile_strength + start);
            holds = (-elastic <= tensile_strength) &
                    (magnitude(stuck) <= load(block.shear_strength + start));
            shear = holds ? stuck : shear;
            const Lanes unbonded = zero + static_cast<double>(not_bonded);
            const Lanes lost = holds ? unbonded : tensile_strength;
            if (any_above(lost, not_bonded)) [[unlikely]]
                for (int k = 0; k < lane_count; ++k)
                    if (lost[k] > static_cast<double>(not_bonded))
                        block.tensile_strength[start + k] = not_bonded;
        }
        if constexpr (law.rolls) {
            const Lanes lever = radius_i * radius_j / reach;
            const Lanes turned =
                load(rolling->moment + start) - load(block.shear_stiffness_times_step + start) *
                                                    (lever * lever) * (spin_j - spin_i);
            const Lanes limit = load(rolling->friction + start) * lever * elastic;
            const Lanes raised = turned < -limit ? -limit : turned;
            const Lanes clipped = limit < raised ? limit : raised;
            moment = (pressed & ~holds & (limit > zero)) ? clipped : zero;
            store(rolling->moment + start, moment);
        }
    }
    const Lanes normal = (holds | pressed) ? elastic : zero;
    store(block.shear_force + start, shear);

    Lanes moment_i = arm_i * shear, moment_j = -(arm_j * shear);
    if constexpr (law.rolls) {
        moment_i += moment;
        moment_j += moment;
    }
    store_rows(reinterpret_cast<double*>(slots + block.slot) + start,
               {normal * nx - shear * ny, normal * ny + shear * nx, moment_i, moment_j});
}

/// Computes contacts whose slots nothing else reads or writes meanwhile. Eight lanes begin a block
/// before the law of the one before it, which then waits for neither root nor quotient; four have
/// too few registers for it.
template <ContactLaw law>
void compute_blocks(const Shared& shared, Blocks& blocks, std::size_t begin, std::size_t end) {
    const double* const discs = reinterpret_cast<const double*>(shared.discs.data());
    Block* block = blocks.blocks.data() + begin;
    Block* const last = blocks.blocks.data() + end;
    // It does no harm to ask for memory beyond the end.
    const auto fetch_later_block = [&block] { prefetch(block + 16, sizeof(Block)); };
    const auto rolling_of = [&]([[maybe_unused]] const Block* of) -> Rolling* {
        if constexpr (law.rolls)
            return blocks.rolling.data() + (of - blocks.blocks.data());
        else
            return nullptr;
    };
    if constexpr (lane_count == 8) {
        if (block == last)
            return;
        Pairs pairs = pairs_of(*block, 0, discs);
        for (; block + 1 != last; ++block) {
            fetch_later_block();
            const Pairs next = pairs_of(block[1], 0, discs);
            compute<law>(*block, 0, pairs, discs, shared.slots, rolling_of(block));
            pairs = next;
        }
        compute<law>(*block, 0, pairs, discs, shared.slots, rolling_of(block));
    } else {
        for (; block != last; ++block) {
            fetch_later_block();
            for (int start = 0; start < 8; start += lane_count)
                compute<law>(*block, start, pairs_of(*block, start, discs), discs, shared.slots,
                             rolling_of(block));
        }
    }
}

template <ContactLaw law> void compute_boundary(const Shared& shared, Strip& strip) {
    compute_blocks<law>(shared, strip.boundary, 0, strip.boundary.blocks.size());
}

/// Adds slots to the forces of a group, `each` of every disc, or takes them off; goes on in the
/// list.
template <int sign>
[[gnu::always_inline]] inline void gather(Double4 (&force)[group_discs], const double* slots,
                                          std::uint32_t each, const std::uint32_t*& list) {
    for (std::uint32_t k = 0; k < each; ++k, list += group_discs)
        for (std::size_t m = 0; m < group_discs; ++m) {
            const Double4 f = load_four(slots + list[m]);
            force[m] = sign > 0 ? force[m] + f : force[m] - f;
        }
}

template <ContactLaw law, DampedAgainst motion, bool has_ghosts>
double sweep(const Shared& shared, Strip& strip, Stretching thins) {
    const Lanes no_force = {};
    const Lanes damping = no_force + shared.damping;
    const Lanes stretches = for_each_disc(thins.rate, -thins.rate, 0.0, 0.0);
    const Lanes floor = for_each_disc(0.0, thins.floor, 0.0, 0.0);
    const Lanes time_step = no_force + shared.time_step;
    const auto sign = reinterpret_cast<Mask>(for_each_disc(-0.0, -0.0, -0.0, 0.0));
    constexpr bool averages =
        motion == DampedAgainst::mean_motion || motion == DampedAgainst::mean_motion_sampled;
    // Share of the sample in the mean; spin is damped as it is, its mean stays 0.
    const Lanes share = no_force + shared.mean_share;
    Mask fastest = {}; // as greater() has it
    const std::span discs = shared.discs;
    const std::span inertias = shared.inertia;
    const std::span<const std::uint32_t> gathers = strip.gathers;
    const double* const slots = reinterpret_cast<const double*>(shared.slots);
    const std::uint32_t* list = gathers.data();
    std::size_t block = 0, group = strip.first_disc / group_discs;
    for (const Tile& tile : strip.tiles) {
        compute_blocks<law>(shared, strip.inner, block, tile.end_block);
        block = tile.end_block;
        for (; group < tile.end_group; ++group) {
            const std::size_t first = group * group_discs;
            prefetch(ahead(discs, first + strip.look_ahead), group_discs * sizeof(Disc));
            prefetch(ahead(inertias, first + 64), group_discs * sizeof(Inertia));
            prefetch(ahead(gathers, static_cast<std::size_t>(list - gathers.data()) + 512), 128);
            Double4 force[group_discs] = {};
            const std::uint32_t more_in = list[0], more_out = list[1];
            list += 2;
            gather<1>(force, slots, usual_slots, list);
            gather<1>(force, slots, more_in, list);
            // From the moment on the second disc to that on the first.
            for (Double4& f : force)
                f = __builtin_shufflevector(f, f, 0, 1, 3, 2);
            gather<-1>(force, slots, usual_slots, list);
            gather<-1>(force, slots, more_out, list);
            for (std::size_t m = 0; m < group_discs; m += rows_at_once) {
                Disc* const moved = &discs[group * group_discs + m];
                Inertia* const of_moved = &inertias[group * group_discs + m];
                // The last number of a disc holds its means.
                const Lanes inertia = load(reinterpret_cast<const double*>(of_moved));
                const Lanes f = of_discs(force + m) - weight_of(inertia);
                const auto [place, v] = load_motion(moved);
                Lanes departs = v;
                Lanes mean = no_force;
                if constexpr (averages) {
                    mean = mean_velocity(of_moved, inertia);
                    departs = v - mean;
                }
                if constexpr (motion == DampedAgainst::stretching)
                    departs = v - stretches * (place - floor);
                const Lanes drag =
                    reinterpret_cast<Lanes>(reinterpret_cast<Mask>(damping * magnitude(f)) |
                                            (reinterpret_cast<Mask>(departs) & sign));
                const Lanes damped = departs == no_force ? f : f - drag;
                const Lanes velocity = v + damped * gain_of(inertia);
                if constexpr (motion == DampedAgainst::mean_motion_sampled) {
                    mean += (velocity - mean) * share;
                    for (std::size_t k = 0; k < rows_at_once; ++k)
                        for (std::size_t n = 0; n < 2; ++n)
                            of_moved[k].mean_velocity[n] = static_cast<float>(mean[4 * k + n]);
                }
                store_motion(moved, {place + velocity * time_step, velocity});
                auto speed = reinterpret_cast<Mask>(magnitude(velocity));
                if constexpr (has_ghosts)
                    speed &= own_discs(shared.own + group * group_discs + m);
                fastest = fastest < speed ? speed : fastest;
            }
        }
    }
    const auto speeds = reinterpret_cast<Lanes>(fastest);
    double greatest = 0.0;
    for (int k = 0; k < lane_count; k += 4)
        greatest = greater(greatest, greater(speeds[k], speeds[k + 1]));
    return greatest;
}

template <ContactLaw law, bool has_ghosts> Kernels kernels_of(DampedAgainst motion) {
    using enum DampedAgainst;
    const auto boundary = &compute_boundary<law>;
    if (motion == mean_motion)
        return {boundary, &sweep<law, mean_motion, has_ghosts>,
                &sweep<law, mean_motion_sampled, has_ghosts>, &sweep<law, rest, has_ghosts>};
    const auto any =
        motion == stretching ? &sweep<law, stretching, has_ghosts> : &sweep<law, rest, has_ghosts>;
    return {boundary, any, any, any};
}

template <ContactLaw law> Kernels kernels_of(DampedAgainst motion, bool has_ghosts) {
    return has_ghosts ? kernels_of<law, true>(motion) : kernels_of<law, false>(motion);
}

template <bool bonded> Kernels kernels_of(ContactLaw law, DampedAgainst motion, bool has_ghosts) {
    if (law.rolls)
        return kernels_of<ContactLaw{bonded, true, true}>(motion, has_ghosts);
    return law.frictional ? kernels_of<ContactLaw{bonded, true, false}>(motion, has_ghosts)
                          : kernels_of<ContactLaw{bonded, false, false}>(motion, has_ghosts);
}

inline Kernels choose_kernels(ContactLaw law, DampedAgainst motion, bool has_ghosts) {
    return law.bonded ? kernels_of<true>(law, motion, has_ghosts)
                      : kernels_of<false>(law, motion, has_ghosts);
}

} // namespace
