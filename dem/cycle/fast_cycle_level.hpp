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

inline void store_four(double* to, Double4 numbers) { std::memcpy(to, &numbers, sizeof numbers); }

/// Mean velocity, m/s, with zeros where there is no mean. Converted by name: g++ 12 would store it
/// and load it again, which waits for the store.
inline Double4 mean_velocity(const float* from) {
#if LISTRIC_LEVEL >= 3
    const __m128i both = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
    return reinterpret_cast<Double4>(_mm256_zextpd128_pd256(_mm_cvtps_pd(_mm_castsi128_ps(both))));
#else
    const Double4 mean = {from[0], from[1], 0.0, 0.0};
    return mean;
#endif
}

/// The numbers with 0 in place of the last.
inline Double4 without_last(Double4 numbers) {
    const Mask4 kept = {-1, -1, -1, 0};
    return reinterpret_cast<Double4>(reinterpret_cast<Mask4>(numbers) & kept);
}

/// Element `k`, or the end.
template <class Element> const Element* ahead(std::span<Element> elements, std::size_t k) {
    return elements.data() + std::min(k, elements.size());
}

/// The contact law of law.hpp and plain_cycle.cpp, as many contacts at a time as there are lanes.
template <bool bonded, bool frictional>
[[gnu::always_inline]] inline void compute(Block& block, const double* discs, Slot* slots) {
    constexpr bool shears = bonded || frictional;
    for (int start = 0; start < 8; start += lane_count) {
        const std::uint32_t* const first = block.first + start;
        const std::uint32_t* const second = block.second + start;
        const auto [dx, dy, radius_i, radius_j] = pair_columns<3>(discs, first, second);

        const Lanes reach = radius_i + radius_j;
        const Lanes square = dx * dx + dy * dy;
        const Lanes distance = square_root(square);
        const Lanes inverse = 1.0 / distance;
        const Lanes nx = dx * inverse, ny = dy * inverse;
        const Lanes overlap = reach - distance;
        const Lanes half = 0.5 * overlap;
        const Lanes arm_i = radius_i - half, arm_j = radius_j - half;
        const Lanes elastic = load(block.normal_stiffness + start) * overlap;
        const Lanes zero = {};
        const Mask pressed = (square < reach * reach) & (overlap > zero);

        Mask holds = {}; // the bond
        Lanes shear = zero;
        if constexpr (shears) {
            const auto [dvx, dvy, spin_i, spin_j] = pair_columns<2>(discs + 4, first, second);
            const Lanes slip_rate = dvy * nx - dvx * ny - (arm_i * spin_i + arm_j * spin_j);
            const Lanes stuck = load(block.shear_force + start) -
                                load(block.shear_stiffness_times_step + start) * slip_rate;
            if constexpr (frictional) {
                const Lanes limit = load(block.friction + start) * elastic;
                const Lanes raised = stuck < -limit ? -limit : stuck;
                const Lanes clipped = limit < raised ? limit : raised;
                shear = (pressed & (limit > zero)) ? clipped : zero;
            }
            if constexpr (bonded) {
                const Lanes tensile_strength = load(block.tensile_strength + start);
                holds = (-elastic <= tensile_strength) &
                        (magnitude(stuck) <= load(block.shear_strength + start));
                shear = holds ? stuck : shear;
                const Mask breaks = ~holds & (tensile_strength > static_cast<double>(not_bonded));
                if (any(breaks)) [[unlikely]]
                    for (int k = 0; k < lane_count; ++k)
                        if (breaks[k])
                            block.tensile_strength[start + k] = not_bonded;
            }
        }
        const Lanes normal = (holds | pressed) ? elastic : zero;
        store(block.shear_force + start, shear);

        store_rows(
            reinterpret_cast<double*>(slots + block.slot) + start,
            {normal * nx - shear * ny, normal * ny + shear * nx, arm_i * shear, -(arm_j * shear)});
    }
}

/// Computes contacts whose slots nothing else reads or writes meanwhile.
template <bool bonded, bool frictional>
void compute_blocks(const Shared& shared, Blocks& blocks, std::size_t begin, std::size_t end) {
    const double* const discs = reinterpret_cast<const double*>(shared.discs.data());
    Slot* const slots = shared.slots;
    Block* const last = blocks.blocks.data() + end;
    for (Block* block = blocks.blocks.data() + begin; block != last; ++block) {
        // It does no harm to ask for memory beyond the end.
        prefetch(block + 16, sizeof(Block));
        compute<bonded, frictional>(*block, discs, slots);
    }
}

template <bool bonded, bool frictional> void compute_boundary(const Shared& shared, Strip& strip) {
    compute_blocks<bonded, frictional>(shared, strip.boundary, 0, strip.boundary.blocks.size());
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

template <bool bonded, bool frictional, DampedAgainst motion, bool has_ghosts>
double sweep(const Shared& shared, Strip& strip, Stretching thins) {
    const Double4 no_force = {};
    const Double4 damping = no_force + shared.damping;
    const Double4 stretches = {thins.rate, -thins.rate, 0.0, 0.0};
    const Double4 floor = {0.0, thins.floor, 0.0, 0.0};
    const Double4 time_step = no_force + shared.time_step;
    const Mask4 sign = {std::numeric_limits<std::int64_t>::min(),
                        std::numeric_limits<std::int64_t>::min(),
                        std::numeric_limits<std::int64_t>::min(), 0};
    constexpr bool averages =
        motion == DampedAgainst::mean_motion || motion == DampedAgainst::mean_motion_sampled;
    // Share of the sample in the mean; spin is damped as it is, its mean stays 0.
    const Double4 share = no_force + shared.mean_share;
    Mask4 fastest = {}; // as greater() has it
    const std::span discs = shared.discs;
    const std::span inertias = shared.inertia;
    const std::span<const std::uint32_t> gathers = strip.gathers;
    const double* const slots = reinterpret_cast<const double*>(shared.slots);
    const std::uint32_t* list = gathers.data();
    std::size_t block = 0, group = strip.first_disc / group_discs;
    for (const Tile& tile : strip.tiles) {
        compute_blocks<bonded, frictional>(shared, strip.inner, block, tile.end_block);
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
            for (std::size_t m = 0; m < group_discs; ++m) {
                Disc& disc = discs[group * group_discs + m];
                Inertia& inertia = inertias[group * group_discs + m];
                const Double4 c = load_four(&inertia); // the last holds the means
                const Double4 gain = without_last(__builtin_shufflevector(c, c, 0, 0, 2, 2));
                const Double4 weight = __builtin_shufflevector(c, no_force, 4, 1, 6, 7);
                const Double4 f = force[m] - weight;
                const Double4 place = load_four(disc.place), v = load_four(disc.velocity);
                Double4 departs = v;
                Double4 mean = no_force;
                if constexpr (averages) {
                    mean = mean_velocity(inertia.mean_velocity);
                    departs = v - mean;
                }
                if constexpr (motion == DampedAgainst::stretching)
                    departs = v - stretches * (place - floor);
                const Double4 drag =
                    reinterpret_cast<Double4>(reinterpret_cast<Mask4>(damping * magnitude(f)) |
                                              (reinterpret_cast<Mask4>(departs) & sign));
                const Double4 damped = departs == no_force ? f : f - drag;
                const Double4 velocity = v + damped * gain;
                if constexpr (motion == DampedAgainst::mean_motion_sampled) {
                    mean += (velocity - mean) * share;
                    inertia.mean_velocity[0] = static_cast<float>(mean[0]);
                    inertia.mean_velocity[1] = static_cast<float>(mean[1]);
                }
                store_four(disc.velocity, velocity);
                store_four(disc.place, place + velocity * time_step);
                auto speed = reinterpret_cast<Mask4>(magnitude(velocity));
                if constexpr (has_ghosts)
                    speed &= shared.own[group * group_discs + m];
                fastest = fastest < speed ? speed : fastest;
            }
        }
    }
    const auto speeds = reinterpret_cast<Double4>(fastest);
    return greater(speeds[0], speeds[1]);
}

template <bool bonded, bool frictional, bool has_ghosts> Kernels kernels_of(DampedAgainst motion) {
    using enum DampedAgainst;
    const auto boundary = &compute_boundary<bonded, frictional>;
    if (motion == mean_motion)
        return {boundary, &sweep<bonded, frictional, mean_motion, has_ghosts>,
                &sweep<bonded, frictional, mean_motion_sampled, has_ghosts>};
    const auto any = motion == stretching ? &sweep<bonded, frictional, stretching, has_ghosts>
                                          : &sweep<bonded, frictional, rest, has_ghosts>;
    return {boundary, any, any};
}

template <bool bonded, bool frictional> Kernels kernels_of(DampedAgainst motion, bool has_ghosts) {
    return has_ghosts ? kernels_of<bonded, frictional, true>(motion)
                      : kernels_of<bonded, frictional, false>(motion);
}

inline Kernels choose_kernels(bool bonded, bool frictional, DampedAgainst motion, bool has_ghosts) {
    if (bonded)
        return frictional ? kernels_of<true, true>(motion, has_ghosts)
                          : kernels_of<true, false>(motion, has_ghosts);
    return frictional ? kernels_of<false, true>(motion, has_ghosts)
                      : kernels_of<false, false>(motion, has_ghosts);
}

} // namespace
