#include "dem/fast_cycle.hpp"

#include "dem/base_contact.hpp"
#include "dem/contacts.hpp"
#include "dem/law.hpp"
#include "dem/order_free.hpp"
#include "dem/team.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

namespace listric::dem {

namespace {

/// Asks for memory that is needed soon.
inline void prefetch(const void* start, std::size_t bytes) {
    for (std::size_t offset = 0; offset < bytes; offset += 64)
        __builtin_prefetch(static_cast<const char*>(start) + offset);
}

Double4 load_slot(const double* from) {
    Double4 slot;
    std::memcpy(&slot, from, sizeof slot);
    return slot;
}

/// Of single precision, with zeros for what has no mean.
Double4 mean_velocity(const float* from) {
    Float4 mean = {};
    std::memcpy(&mean, from, 2 * sizeof(float));
    return __builtin_convertvector(mean, Double4);
}

/// Element `k`, or the end.
template <class Vector> const auto* ahead(const Vector& vector, std::size_t k) {
    return vector.data() + std::min(k, vector.size());
}

} // namespace

/// The contact law of law.hpp and plain_cycle.cpp, as many contacts at a time as there are lanes.
template <bool bonded, bool frictional>
[[gnu::always_inline]] inline void FastCycle::compute(Block& block, const double* discs,
                                                      Slot* slots) {
    constexpr bool shears = bonded || frictional;
    for (int start = 0; start < 8; start += lane_count) {
        // A row a contact: from its first disc to its second, and what it needs of each.
        const std::uint32_t* const first = block.first + start;
        const std::uint32_t* const second = block.second + start;
        Lanes near[4], rates[4];
        for (int k = 0; k < 4; ++k) {
            const Lanes place_i = load_rows(discs, first, k), place_j = load_rows(discs, second, k);
            near[k] = first_and_second_half(place_j - place_i, odd_numbers(place_i, place_j));
            if constexpr (shears) {
                const Lanes motion_i = load_rows(discs + 4, first, k);
                const Lanes motion_j = load_rows(discs + 4, second, k);
                rates[k] =
                    first_and_second_half(motion_j - motion_i, even_numbers(motion_i, motion_j));
            }
        }
        const auto [dx, dy, radius_i, radius_j] = transpose({near[0], near[1], near[2], near[3]});

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
            const auto [dvx, dvy, spin_i, spin_j] =
                transpose({rates[0], rates[1], rates[2], rates[3]});
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

        const auto [a, b, c, d] = transpose(
            {normal * nx - shear * ny, normal * ny + shear * nx, arm_i * shear, -(arm_j * shear)});
        double* const to = reinterpret_cast<double*>(slots + block.slot + start);
        store(to, a);
        store(to + lane_count, b);
        store(to + 2 * lane_count, c);
        store(to + 3 * lane_count, d);
    }
}

/// Computes contacts whose slots nothing else reads or writes meanwhile.
template <bool bonded, bool frictional>
void FastCycle::compute_blocks(Blocks& blocks, std::size_t begin, std::size_t end) {
    const double* const discs = reinterpret_cast<const double*>(discs_.data());
    Slot* const slots = slots_.data();
    Block* const last = blocks.blocks.data() + end;
    for (Block* block = blocks.blocks.data() + begin; block != last; ++block) {
        // It does no harm to ask for memory beyond the end.
        prefetch(block + 16, sizeof(Block));
        compute<bonded, frictional>(*block, discs, slots);
    }
}

void FastCycle::compute_base(Strip& strip, BaseMoment base) {
    for (BaseContact& contact : strip.base_contacts) {
        const Disc& d = discs_[static_cast<std::size_t>(contact.disc)];
        const BaseContactForce f = base_contact_force(
            *contact.surface, base,
            {d.place[0], d.place[1], d.velocity[0], d.velocity[1], d.velocity[2], d.place[3]},
            contact.parameters, contact.shear_force);
        slots_[contact.slot] = Slot{f.x, f.y, 0.0, f.moment};
    }
}

void FastCycle::compute_nodes(Strip& strip, const BaseNodeColumns& nodes, BaseMoment base) {
    for (NodeContact& node_contact : strip.node_contacts) {
        BaseContact& contact = node_contact.contact;
        const Disc& d = discs_[static_cast<std::size_t>(contact.disc)];
        node_contact.force = node_contact_force(
            *contact.surface, nodes, base,
            {d.place[0], d.place[1], d.velocity[0], d.velocity[1], d.velocity[2], d.place[3]},
            contact.parameters, contact.shear_force, node_contact.place);
        const BaseContactForce& f = node_contact.force.force;
        slots_[contact.slot] = Slot{f.x, f.y, 0.0, f.moment};
    }
}

/// As in the plain cycle: loads by row, which is the order of strips and of their contacts.
double FastCycle::move_base(State& state, const BaseNodeColumns& nodes, const Clock& clock,
                            BaseResponse* response) {
    for (const Strip& strip : strips_)
        for (const NodeContact& c : strip.node_contacts)
            add_load(nodes, c.force, c.contact.surface->degree);
    if (response && (clock.cycle + 1) % response->interval == 0)
        response->respond(state, clock);
    return move_nodes(nodes, clock.time_step);
}

template <bool bonded, bool frictional> void FastCycle::compute_boundary(Strip& strip) {
    compute_blocks<bonded, frictional>(strip.boundary, 0, strip.boundary.blocks.size());
}

/// The last is no number of its own: it holds the means.
Double4 FastCycle::numbers_of(const Inertia& inertia) {
    static_assert(sizeof(Inertia) == sizeof(Double4));
    Double4 numbers;
    std::memcpy(&numbers, &inertia, sizeof numbers);
    return numbers;
}

template <bool bonded, bool frictional, DampedAgainst motion>
double FastCycle::sweep(Strip& strip, Stretching thins) {
    const Double4 no_force = {};
    const Double4 damping = no_force + physics_.damping;
    const Double4 stretches = {thins.rate, -thins.rate, 0.0, 0.0};
    const Double4 floor = {0.0, thins.floor, 0.0, 0.0};
    const Double4 time_step = no_force + time_step_;
    const Mask4 sign = {std::numeric_limits<std::int64_t>::min(),
                        std::numeric_limits<std::int64_t>::min(),
                        std::numeric_limits<std::int64_t>::min(), 0};
    constexpr bool averages =
        motion == DampedAgainst::mean_motion || motion == DampedAgainst::mean_motion_sampled;
    // Of the sample in the mean; spin is damped as it is, its mean stays 0.
    const Double4 share =
        no_force + (averages ? averaging_interval * time_step_ / physics_.averaging_time : 0.0);
    Mask4 fastest = {}; // as greater() has it
    const double* const slots = reinterpret_cast<const double*>(slots_.data());
    const std::uint32_t* list = strip.gathers.data();
    std::size_t block = 0, group = strip.first_disc / group_discs;
    for (const Tile& tile : strip.tiles) {
        compute_blocks<bonded, frictional>(strip.inner, block, tile.end_block);
        block = tile.end_block;
        for (; group < tile.end_group; ++group) {
            const std::size_t first = group * group_discs;
            prefetch(ahead(discs_, first + strip.look_ahead), group_discs * sizeof(Disc));
            prefetch(ahead(inertia_, first + 64), group_discs * sizeof(Inertia));
            prefetch(
                ahead(strip.gathers, static_cast<std::size_t>(list - strip.gathers.data()) + 512),
                128);
            Double4 force[group_discs] = {};
            const std::uint32_t in = list[0], out = list[1];
            list += 2;
            for (std::uint32_t k = 0; k < in; ++k, list += group_discs)
                for (std::size_t m = 0; m < group_discs; ++m)
                    force[m] += load_slot(slots + list[m]);
            // From the moment on the second disc to that on the first.
            for (Double4& f : force)
                f = __builtin_shufflevector(f, f, 0, 1, 3, 2);
            for (std::uint32_t k = 0; k < out; ++k, list += group_discs)
                for (std::size_t m = 0; m < group_discs; ++m)
                    force[m] -= load_slot(slots + list[m]);
            for (std::size_t m = 0; m < group_discs; ++m) {
                Disc& disc = discs_[group * group_discs + m];
                Inertia& inertia = inertia_[group * group_discs + m];
                const Double4 c = numbers_of(inertia);
                const Double4 gain = __builtin_shufflevector(c, no_force, 0, 0, 2, 4);
                const Double4 weight = __builtin_shufflevector(c, no_force, 4, 1, 4, 4);
                const Double4 f = force[m] - weight;
                const Double4 v = disc.velocity;
                Double4 departs = v;
                Double4 mean = no_force;
                if constexpr (averages) {
                    mean = mean_velocity(inertia.mean_velocity);
                    departs = v - mean;
                }
                if constexpr (motion == DampedAgainst::stretching)
                    departs = v - stretches * (disc.place - floor);
                const Double4 drag =
                    reinterpret_cast<Double4>(reinterpret_cast<Mask4>(damping * magnitude(f)) |
                                              (reinterpret_cast<Mask4>(departs) & sign));
                const Double4 damped = departs == no_force ? f : f - drag;
                disc.velocity = v + damped * gain;
                if constexpr (motion == DampedAgainst::mean_motion_sampled) {
                    mean += (disc.velocity - mean) * share;
                    inertia.mean_velocity[0] = static_cast<float>(mean[0]);
                    inertia.mean_velocity[1] = static_cast<float>(mean[1]);
                }
                disc.place += disc.velocity * time_step;
                const auto speed = reinterpret_cast<Mask4>(magnitude(disc.velocity));
                fastest = fastest < speed ? speed : fastest;
            }
        }
    }
    const auto speeds = reinterpret_cast<Double4>(fastest);
    return greater(speeds[0], speeds[1]);
}

template <bool bonded, bool frictional> FastCycle::Kernels FastCycle::kernels_of() const {
    const auto boundary = &FastCycle::compute_boundary<bonded, frictional>;
    if (physics_.averaging_time > 0.0)
        return {boundary, &FastCycle::sweep<bonded, frictional, DampedAgainst::mean_motion>,
                &FastCycle::sweep<bonded, frictional, DampedAgainst::mean_motion_sampled>};
    const auto sweep = stretching(base_, 0.0).rate > 0.0
                           ? &FastCycle::sweep<bonded, frictional, DampedAgainst::stretching>
                           : &FastCycle::sweep<bonded, frictional, DampedAgainst::rest>;
    return {boundary, sweep, sweep};
}

FastCycle::Kernels FastCycle::choose_kernels() const {
    if (bonded_)
        return frictional_ ? kernels_of<true, true>() : kernels_of<true, false>();
    return frictional_ ? kernels_of<false, true>() : kernels_of<false, false>();
}

/// Square of the greatest distance of the strip's discs from their searched places, m^2.
double FastCycle::furthest(const Strip& strip) const {
    double greatest = 0.0;
    for (std::size_t i = strip.first_disc; i < strip.end_disc; ++i) {
        const double dx = discs_[i].place[0] - searched_places_[i].x;
        const double dy = discs_[i].place[1] - searched_places_[i].y;
        greatest = greater(greatest, dx * dx + dy * dy);
    }
    return greatest;
}

std::int64_t FastCycle::run(State& state, std::int64_t cycles, BaseResponse* response) {
    const Kernels kernels = choose_kernels();
    const Clock start = state.clock;
    const Watch watched{state.displacement_bound, state.window_speed, state.look_interval};
    const double surface_translation = greatest_translation(base_);
    const BaseNodeColumns nodes = base_node_columns(state);
    Barrier barrier(static_cast<int>(strips_.size()));
    run_team(static_cast<int>(strips_.size()), [&](int thread) {
        // Each thread keeps clock and watch for itself; all come to the same decisions.
        Strip& strip = strips_[static_cast<std::size_t>(thread)];
        Clock clock = start;
        Watch watch = watched;
        for (std::int64_t n = 0; n < cycles; ++n) {
            if (clock.cycle % watch.look_interval == 0) {
                if (is_check_due(watch.bound, state.skin)) {
                    strip.furthest = furthest(strip);
                    barrier.wait();
                    double square = 0.0;
                    for (const Strip& s : strips_)
                        square = greater(square, s.furthest);
                    watch.bound =
                        greater(std::sqrt(square), surface_travel(state, base_, clock.extension));
                    if (is_update_due(watch.bound, state.skin))
                        break;
                }
                watch.look_interval = next_look_interval(watch.look_interval, watch.speed,
                                                         clock.time_step, state.skin);
                watch.speed = 0.0;
            }
            const double speed = base_.motion.speed_at(clock.time());
            compute_base(strip, {clock.extension, speed});
            if (deforms_)
                compute_nodes(strip, nodes, {clock.extension, speed});
            (this->*kernels.compute_boundary)(strip);
            barrier.wait();
            const auto parity = static_cast<std::size_t>(clock.cycle % 2);
            // No disc looks at the nodes between the two barriers.
            if (deforms_ && thread == 0)
                fastest_node_[parity] = move_base(state, nodes, clock, response);
            Stretching thins = stretching(base_, clock.extension);
            thins.rate *= speed;
            const auto sweep =
                clock.cycle % averaging_interval == 0 ? kernels.sampling_sweep : kernels.sweep;
            strip.fastest[parity] = (this->*sweep)(strip, thins);
            barrier.wait();
            double fastest = greater(surface_translation * speed, fastest_node_[parity]);
            for (const Strip& s : strips_)
                fastest = greater(fastest, s.fastest[parity]);
            watch.speed = greater(watch.speed, fastest);
            watch.bound += std::numbers::sqrt2 * fastest * clock.time_step;
            clock.extension += speed * clock.time_step;
            ++clock.cycle;
        }
        barrier.wait(); // until all have read the state
        if (thread == 0) {
            state.clock = clock;
            state.displacement_bound = watch.bound;
            state.window_speed = watch.speed;
            state.look_interval = watch.look_interval;
        }
    });
    return state.clock.cycle - start.cycle;
}

void advance_fast(State& state, const RigidBase& base, const CyclePhysics& physics,
                  std::int64_t cycles, int threads, BaseResponse* response) {
    FastCycle fast(state, base, physics, threads);
    while (cycles > 0) {
        cycles -= fast.run(state, cycles, response);
        if (cycles == 0)
            break;
        fast.unpack(state);
        refuse_runaways(state);
        if (update_contacts(state, base))
            fast.pack_contacts(state);
        fast.pack_searched_places(state);
    }
    fast.unpack(state);
}

} // namespace listric::dem
