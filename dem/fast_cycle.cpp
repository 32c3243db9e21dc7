#include "dem/fast_cycle.hpp"

#include "dem/base_contact.hpp"
#include "dem/law.hpp"
#include "dem/team.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numbers>

namespace listric {

namespace {

constexpr std::size_t tile_discs = 128; ///< a tile's records, slots and contacts fit the cache
constexpr std::size_t group_discs = 4;  ///< discs that gather together
constexpr float not_bonded = -std::numeric_limits<float>::infinity();

} // namespace

FastCycle::FastCycle(const State& state, const RigidBase& base, const CyclePhysics& physics,
                     int threads)
    : base_(base), physics_(physics), time_step_(state.clock.time_step) {
    const ConstDiscColumns d = disc_columns(state);
    disc_count_ = d.x.size();
    // Whole groups, and two discs far from everything for the idle lanes of a block.
    const std::size_t padded = (disc_count_ + group_discs - 1) / group_discs * group_discs;
    discs_.assign(padded + 2, Disc{{0.0, 0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, 0.0}});
    constants_.assign(padded, DiscConstants{0.0, 0.0, 0.0, 0.0});
    discs_[padded].place[0] = -1e30;
    discs_[padded + 1].place[0] = 1e30;
    for (std::size_t i = 0; i < disc_count_; ++i) {
        discs_[i].place = Double4{d.x[i], d.y[i], d.rotation[i], d.radius[i]};
        discs_[i].velocity = Double4{d.vx[i], d.vy[i], d.spin[i], 0.0};
        const double inertia = std::max(d.mass[i], state.inertial_mass_floor);
        const double acceleration_per_force = time_step_ / inertia;
        constants_[i] =
            DiscConstants{acceleration_per_force, d.mass[i] * physics.gravity,
                          acceleration_per_force * (2.0 / (d.radius[i] * d.radius[i])), 0.0};
    }
    pack_contacts(state, threads);
}

void FastCycle::pack_contacts(const State& state, int threads) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    const std::size_t tiles = (disc_count_ + tile_discs - 1) / tile_discs;
    const std::size_t strips = std::clamp<std::size_t>(static_cast<std::size_t>(threads), 1,
                                                       std::max<std::size_t>(tiles, 1));
    strips_ = std::vector<Strip>(strips);
    const auto idle = static_cast<std::int32_t>(discs_.size() - 2);

    // Slot of every contact and base contact, filled in below; then each disc's gathering list.
    std::vector<std::uint32_t> slot_of(c.first.size()), base_slot_of(b.disc.size());
    std::size_t slots = 1; // slot 0 stays zero
    std::size_t row = 0, base_row = 0;
    for (std::size_t s = 0; s < strips; ++s) {
        Strip& strip = strips_[s];
        const std::size_t first_tile = s * tiles / strips, end_tile = (s + 1) * tiles / strips;
        const std::size_t end_disc = std::min(end_tile * tile_discs, disc_count_);
        strip.first_disc = first_tile * tile_discs;

        const auto append = [&](AlignedVector<Block>& blocks, std::vector<std::int32_t>& rows,
                                std::size_t& lane, std::size_t k) {
            if (lane == 0) {
                Block& block = blocks.emplace_back(); // zeros
                std::ranges::fill(block.tensile_strength, not_bonded);
                std::ranges::fill(block.first, idle);
                std::ranges::fill(block.second, idle + 1);
                rows.resize(rows.size() + 8, -1);
            }
            Block& block = blocks.back();
            const auto i = static_cast<std::size_t>(c.first[k]);
            const auto j = static_cast<std::size_t>(c.second[k]);
            const ContactParameters p = contact_parameters(
                state.materials[d.material[i]], state.materials[d.material[j]], time_step_);
            block.shear_force[lane] = c.shear_force[k];
            block.normal_stiffness[lane] = p.normal_stiffness;
            block.shear_stiffness_times_step[lane] = p.shear_stiffness_times_step;
            block.friction[lane] = p.friction;
            block.tensile_strength[lane] = c.bonded[k] ? c.tensile_strength[k] : not_bonded;
            block.shear_strength[lane] = c.shear_strength[k];
            block.first[lane] = c.first[k];
            block.second[lane] = c.second[k];
            rows[rows.size() - 8 + lane] = static_cast<std::int32_t>(k);
            lane = (lane + 1) % 8;
        };

        std::size_t boundary_lane = 0;
        std::vector<std::pair<std::size_t, std::size_t>> tile_rows;
        for (std::size_t t = first_tile; t < end_tile; ++t) {
            const std::size_t end = std::min((t + 1) * tile_discs, disc_count_);
            std::size_t lane = 0;
            for (; row < c.first.size() && static_cast<std::size_t>(c.first[row]) < end; ++row)
                if (static_cast<std::size_t>(c.second[row]) < end_disc)
                    append(strip.blocks, strip.block_rows, lane, row);
                else
                    append(strip.boundary_blocks, strip.boundary_rows, boundary_lane, row);
            strip.tiles.push_back({strip.blocks.size(), (end + group_discs - 1) / group_discs});
        }

        // The ring: a slot may be written again once the last disc that gathers it has moved.
        std::vector<std::size_t> position(strip.block_rows.size());
        std::size_t furthest = 8;
        std::size_t block = 0;
        for (const Tile& tile : strip.tiles)
            for (; block < tile.end_block; ++block)
                for (std::size_t lane = 0; lane < 8; ++lane) {
                    const std::int32_t k = strip.block_rows[8 * block + lane];
                    if (k < 0)
                        continue;
                    const auto second =
                        static_cast<std::size_t>(c.second[static_cast<std::size_t>(k)]);
                    const Tile& gathers = strip.tiles[second / tile_discs - first_tile];
                    furthest = std::max(furthest, 8 * (gathers.end_block - block));
                }
        const std::size_t ring = std::bit_ceil(furthest);
        const std::size_t ring_start = (slots + 7) / 8 * 8;
        for (std::size_t k = 0; k < strip.blocks.size(); ++k) {
            strip.blocks[k].slot = static_cast<std::uint32_t>(ring_start + (8 * k) % ring);
            for (std::size_t lane = 0; lane < 8; ++lane)
                if (const std::int32_t r = strip.block_rows[8 * k + lane]; r >= 0)
                    slot_of[static_cast<std::size_t>(r)] =
                        strip.blocks[k].slot + static_cast<std::uint32_t>(lane);
        }
        slots = ring_start + ring;
        for (std::size_t k = 0; k < strip.boundary_blocks.size(); ++k) {
            strip.boundary_blocks[k].slot = static_cast<std::uint32_t>(slots);
            for (std::size_t lane = 0; lane < 8; ++lane)
                if (const std::int32_t r = strip.boundary_rows[8 * k + lane]; r >= 0)
                    slot_of[static_cast<std::size_t>(r)] =
                        strip.boundary_blocks[k].slot + static_cast<std::uint32_t>(lane);
            slots += 8;
        }
        strip.first_base_row = base_row;
        for (; base_row < b.disc.size() && static_cast<std::size_t>(b.disc[base_row]) < end_disc;
             ++base_row) {
            const auto i = static_cast<std::size_t>(b.disc[base_row]);
            base_slot_of[base_row] = static_cast<std::uint32_t>(slots);
            strip.base_contacts.push_back(
                {b.disc[base_row], &base_.surfaces[static_cast<std::size_t>(b.surface[base_row])],
                 contact_parameters(base_.material, state.materials[d.material[i]], time_step_),
                 b.shear_force[base_row], static_cast<std::uint32_t>(slots)});
            ++slots;
        }
    }
    slots_.assign(slots, Slot{0.0, 0.0, 0.0, 0.0});

    // Gathering lists. Per group of discs: how many slots come in (as second disc or from the
    // base) and go out (as first disc), then the slots, interleaved by disc; short lists are filled
    // up with the zero slot.
    std::vector<std::vector<std::uint32_t>> in(discs_.size()), out(discs_.size());
    for (std::size_t k = 0; k < b.disc.size(); ++k)
        in[static_cast<std::size_t>(b.disc[k])].push_back(base_slot_of[k]);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        in[static_cast<std::size_t>(c.second[k])].push_back(slot_of[k]);
        out[static_cast<std::size_t>(c.first[k])].push_back(slot_of[k]);
    }
    for (Strip& strip : strips_) {
        std::size_t group = strip.first_disc / group_discs;
        for (const Tile& tile : strip.tiles)
            for (; group < tile.end_group; ++group) {
                std::size_t most_in = 0, most_out = 0;
                for (std::size_t m = 0; m < group_discs; ++m) {
                    most_in = std::max(most_in, in[group_discs * group + m].size());
                    most_out = std::max(most_out, out[group_discs * group + m].size());
                }
                strip.gathers.push_back(static_cast<std::uint32_t>(most_in));
                strip.gathers.push_back(static_cast<std::uint32_t>(most_out));
                const auto interleave = [&](const auto& lists, std::size_t most) {
                    for (std::size_t k = 0; k < most; ++k)
                        for (std::size_t m = 0; m < group_discs; ++m) {
                            const auto& list = lists[group_discs * group + m];
                            strip.gathers.push_back(k < list.size() ? list[k] : 0);
                        }
                };
                interleave(in, most_in);
                interleave(out, most_out);
            }
    }
}

/// The contact law of law.hpp and cycle.cpp, as many contacts at a time as there are lanes.
inline void FastCycle::compute(Block& block) {
    for (int start = 0; start < 8; start += lane_count) {
        Double4 near_rows[lane_count], rate_rows[lane_count];
        for (int k = 0; k < lane_count; ++k) {
            const Disc& i = discs_[static_cast<std::size_t>(block.first[start + k])];
            const Disc& j = discs_[static_cast<std::size_t>(block.second[start + k])];
            const Double4 radii = __builtin_shufflevector(i.place, j.place, 1, 5, 3, 7);
            near_rows[k] = __builtin_shufflevector(j.place - i.place, radii, 0, 1, 6, 7);
            const Double4 spins = __builtin_shufflevector(i.velocity, j.velocity, 0, 4, 2, 6);
            rate_rows[k] = __builtin_shufflevector(j.velocity - i.velocity, spins, 0, 1, 6, 7);
        }
        const auto [dx, dy, radius_i, radius_j] = transpose(near_rows);
        const auto [dvx, dvy, spin_i, spin_j] = transpose(rate_rows);

        const Lanes reach = radius_i + radius_j;
        const Lanes square = dx * dx + dy * dy;
        const Lanes distance = square_root(square);
        const Lanes inverse = 1.0 / distance;
        const Lanes nx = dx * inverse, ny = dy * inverse;
        const Lanes overlap = reach - distance;
        const Lanes half = 0.5 * overlap;
        const Lanes arm_i = radius_i - half, arm_j = radius_j - half;
        const Lanes slip_rate = dvy * nx - dvx * ny - (arm_i * spin_i + arm_j * spin_j);

        const Lanes zero = {};
        const Lanes elastic = load(block.normal_stiffness + start) * overlap;
        const Lanes stuck = load(block.shear_force + start) -
                            load(block.shear_stiffness_times_step + start) * slip_rate;
        const Lanes tensile_strength = load(block.tensile_strength + start);
        const Mask holds = (-elastic <= tensile_strength) &
                           (magnitude(stuck) <= load(block.shear_strength + start));
        const Mask pressed = (square < reach * reach) & (overlap > zero);
        const Lanes limit = load(block.friction + start) * elastic;
        const Lanes raised = stuck < -limit ? -limit : stuck;
        const Lanes clipped = limit < raised ? limit : raised;
        const Lanes shear = holds ? stuck : (pressed ? clipped : zero);
        const Lanes normal = (holds | pressed) ? elastic : zero;
        store(block.shear_force + start, shear);

        const Mask breaks = ~holds & (tensile_strength > static_cast<double>(not_bonded));
        if (any(breaks)) [[unlikely]]
            for (int k = 0; k < lane_count; ++k)
                if (breaks[k])
                    block.tensile_strength[start + k] = not_bonded;

        Double4 rows[lane_count];
        transpose(
            {normal * nx - shear * ny, normal * ny + shear * nx, arm_i * shear, -(arm_j * shear)},
            rows);
        for (int k = 0; k < lane_count; ++k)
            slots_[block.slot + static_cast<std::uint32_t>(start + k)] = rows[k];
    }
}

void FastCycle::compute_base(Strip& strip, double extension, double speed) {
    for (BaseContact& contact : strip.base_contacts) {
        const Disc& d = discs_[static_cast<std::size_t>(contact.disc)];
        const BaseContactForce f = base_contact_force(
            *contact.surface, extension, speed,
            {d.place[0], d.place[1], d.velocity[0], d.velocity[1], d.velocity[2], d.place[3]},
            contact.parameters, contact.shear_force);
        slots_[contact.slot] = Slot{f.x, f.y, 0.0, f.moment};
    }
}

void FastCycle::sweep(Strip& strip) {
    const Double4 no_force = {};
    const Double4 damping = no_force + physics_.damping;
    const Double4 time_step = no_force + time_step_;
    const Mask4 sign = {std::numeric_limits<std::int64_t>::min(),
                        std::numeric_limits<std::int64_t>::min(),
                        std::numeric_limits<std::int64_t>::min(), 0};
    Double4 fastest = no_force;
    const Slot* const slots = slots_.data();
    const std::uint32_t* list = strip.gathers.data();
    std::size_t block = 0, group = strip.first_disc / group_discs;
    for (const Tile& tile : strip.tiles) {
        for (; block < tile.end_block; ++block)
            compute(strip.blocks[block]);
        for (; group < tile.end_group; ++group) {
            Double4 force[group_discs] = {};
            const std::uint32_t in = list[0], out = list[1];
            list += 2;
            for (std::uint32_t k = 0; k < in; ++k, list += group_discs)
                for (std::size_t m = 0; m < group_discs; ++m)
                    force[m] += slots[list[m]];
            // From the moment on the second disc to that on the first.
            for (Double4& f : force)
                f = __builtin_shufflevector(f, f, 0, 1, 3, 2);
            for (std::uint32_t k = 0; k < out; ++k, list += group_discs)
                for (std::size_t m = 0; m < group_discs; ++m)
                    force[m] -= slots[list[m]];
            for (std::size_t m = 0; m < group_discs; ++m) {
                Disc& disc = discs_[group * group_discs + m];
                const DiscConstants c = constants_[group * group_discs + m];
                const Double4 gain = __builtin_shufflevector(c, no_force, 0, 0, 2, 3);
                const Double4 weight = __builtin_shufflevector(c, no_force, 4, 1, 4, 4);
                const Double4 f = force[m] - weight;
                const Double4 v = disc.velocity;
                const Double4 drag =
                    reinterpret_cast<Double4>(reinterpret_cast<Mask4>(damping * magnitude(f)) |
                                              (reinterpret_cast<Mask4>(v) & sign));
                const Double4 damped = v == no_force ? f : f - drag;
                disc.velocity = v + damped * gain;
                disc.place += disc.velocity * time_step;
                const Double4 speed = magnitude(disc.velocity);
                fastest = fastest < speed ? speed : fastest;
            }
        }
    }
    strip.fastest = std::max(fastest[0], fastest[1]);
}

std::int64_t FastCycle::run(State& state, std::int64_t cycles, double limit) {
    Barrier barrier(static_cast<int>(strips_.size()));
    const Clock start = state.clock;
    const double start_bound = state.displacement_bound;
    std::int64_t done = 0;
    run_team(static_cast<int>(strips_.size()), [&](int thread) {
        // Each thread keeps the clock for itself; all come to the same decisions.
        Strip& strip = strips_[static_cast<std::size_t>(thread)];
        Clock clock = start;
        double bound = start_bound;
        std::int64_t n = 0;
        while (n < cycles && !(bound > limit)) {
            const double speed = base_.motion.speed_at(clock.time());
            compute_base(strip, clock.extension, speed);
            for (Block& block : strip.boundary_blocks)
                compute(block);
            barrier.wait();
            sweep(strip);
            barrier.wait();
            double fastest = 0.0;
            for (const Strip& s : strips_)
                fastest = std::max(fastest, s.fastest);
            bound += std::numbers::sqrt2 * fastest * clock.time_step;
            clock.extension += speed * clock.time_step;
            ++clock.cycle;
            ++n;
            // Nobody may overwrite its speed before all have read it.
            barrier.wait();
        }
        if (thread == 0) {
            state.clock = clock;
            state.displacement_bound = bound;
            done = n;
        }
    });
    return done;
}

void FastCycle::unpack(State& state) const {
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < disc_count_; ++i) {
        const Disc& disc = discs_[i];
        d.x[i] = disc.place[0];
        d.y[i] = disc.place[1];
        d.rotation[i] = disc.place[2];
        d.vx[i] = disc.velocity[0];
        d.vy[i] = disc.velocity[1];
        d.spin[i] = disc.velocity[2];
    }
    const ContactColumns c = contact_columns(state);
    const BaseContactColumns b = base_contact_columns(state);
    const auto restore = [&](const AlignedVector<Block>& blocks,
                             const std::vector<std::int32_t>& rows) {
        for (std::size_t lane = 0; lane < rows.size(); ++lane)
            if (rows[lane] >= 0) {
                const auto k = static_cast<std::size_t>(rows[lane]);
                const Block& block = blocks[lane / 8];
                c.shear_force[k] = block.shear_force[lane % 8];
                c.bonded[k] = block.tensile_strength[lane % 8] > not_bonded;
            }
    };
    for (const Strip& strip : strips_) {
        restore(strip.blocks, strip.block_rows);
        restore(strip.boundary_blocks, strip.boundary_rows);
        for (std::size_t k = 0; k < strip.base_contacts.size(); ++k)
            b.shear_force[strip.first_base_row + k] = strip.base_contacts[k].shear_force;
    }
}

} // namespace listric
