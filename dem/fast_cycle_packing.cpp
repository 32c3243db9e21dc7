// Packing: from the state's columns to the records of the fast cycle, and back.

#include "dem/fast_cycle.hpp"
#include "dem/law.hpp"
#include "dem/radius_rates.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace listric::dem {

using namespace fast;

FastCycle::FastCycle(const State& state, const RigidBase& base, const CyclePhysics& physics,
                     int threads, Cycle level)
    : level_(level), base_(base), physics_(physics), time_step_(state.clock.time_step) {
    const ConstDiscColumns d = disc_columns(state);
    disc_count_ = d.x.size();
    // Whole groups, and two discs far from everything for the idle lanes of a block.
    const std::size_t padded = (disc_count_ + group_discs - 1) / group_discs * group_discs;
    discs_.assign(padded + 2, Disc{{0.0, 0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, 0.0}});
    inertia_.assign(padded, Inertia{});
    discs_[padded].place[0] = -1e30;
    discs_[padded + 1].place[0] = 1e30;
    const RadiusRates radii(state);
    for (std::size_t i = 0; i < disc_count_; ++i) {
        discs_[i] = {{d.x[i], d.y[i], d.rotation[i], d.radius[i]},
                     {d.vx[i], d.vy[i], d.spin[i], radii[i]}};
        const double acceleration_per_force =
            time_step_ / std::max(d.mass[i], state.inertial_mass_floor);
        const double radius = radii.of_inertia(i, d.radius[i]);
        inertia_[i] = {acceleration_per_force,
                       d.mass[i] * physics.gravity,
                       acceleration_per_force * (2.0 / (radius * radius)),
                       {}};
    }
    if (physics.averaging_time > 0.0) {
        const auto mean_vx = state.discs.get<float>("mean_vx");
        const auto mean_vy = state.discs.get<float>("mean_vy");
        for (std::size_t i = 0; i < disc_count_; ++i)
            std::ranges::copy(std::array{mean_vx[i], mean_vy[i]}, inertia_[i].mean_velocity);
    }
    deforms_ = state.base_nodes.rows() > 0;
    divide_work(state, threads);
    pack_searched_places(state);
    pack_contacts(state);
}

/// Gives each thread whole tiles of about equal work: a contact takes about as long as a disc, a
/// base contact as five.
void FastCycle::divide_work(const State& state, int threads) {
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    const std::size_t tiles = (disc_count_ + tile_discs - 1) / tile_discs;
    std::vector<std::size_t> work(tiles, tile_discs);
    for (const std::int32_t first : c.first)
        work[static_cast<std::size_t>(first) / tile_discs] += 1;
    for (const std::int32_t disc : b.disc)
        work[static_cast<std::size_t>(disc) / tile_discs] += 5;
    const std::size_t all = std::accumulate(work.begin(), work.end(), std::size_t{0});

    strips_.resize(std::clamp<std::size_t>(static_cast<std::size_t>(threads), 1,
                                           std::max<std::size_t>(tiles, 1)));
    std::size_t tile = 0, done = 0;
    for (std::size_t s = 0; s < strips_.size(); ++s) {
        strips_[s].first_disc = std::min(tile * tile_discs, disc_count_);
        for (; tile < tiles && done + work[tile] / 2 < all * (s + 1) / strips_.size(); ++tile)
            done += work[tile];
        strips_[s].end_disc = std::min(tile * tile_discs, disc_count_);
    }
}

void FastCycle::pack_searched_places(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    searched_places_.resize(disc_count_);
    for (std::size_t i = 0; i < disc_count_; ++i)
        searched_places_[i] = {d.searched_x[i], d.searched_y[i]};
}

void FastCycle::pack_contacts(const State& state) {
    slot_of_.resize(state.contacts.rows());
    base_slot_of_.resize(state.base_contacts.rows());
    bonded_ = frictional_ = false;
    std::size_t slot = 1; // slot 0 stays zero
    std::size_t row = 0, base_row = 0;
    for (Strip& strip : strips_) {
        row = pack_blocks(state, row, strip);
        slot = assign_slots(slot, strip);
        base_row = pack_base_contacts(state, base_row, slot, strip);
        slot += strip.base_contacts.size() + strip.node_contacts.size();
    }
    slots_.assign(slot, Slot{0.0, 0.0, 0.0, 0.0});
    pack_gathers(state);
}

/// Fills the strip's blocks with the contacts of its discs, which begin at `row`. Returns the row
/// after them.
std::size_t FastCycle::pack_blocks(const State& state, std::size_t row, Strip& strip) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const PairParameters pairs(state.materials, time_step_);
    const auto numbers = [](auto disc) {
        return static_cast<std::uint32_t>(disc_numbers * static_cast<std::size_t>(disc));
    };
    const std::size_t idle = discs_.size() - 2;
    std::int32_t furthest = 0; // second disc from the first
    const auto append = [&](Blocks& to, std::size_t& lane) {
        if (lane == 0) {
            Block& block = to.blocks.emplace_back(); // zeros
            std::ranges::fill(block.tensile_strength, not_bonded);
            std::ranges::fill(block.first, numbers(idle));
            std::ranges::fill(block.second, numbers(idle + 1));
            to.rows.resize(to.rows.size() + 8, -1);
        }
        Block& block = to.blocks.back();
        const ContactParameters& p = pairs(d.material[static_cast<std::size_t>(c.first[row])],
                                           d.material[static_cast<std::size_t>(c.second[row])]);
        block.shear_force[lane] = c.shear_force[row];
        block.normal_stiffness[lane] = p.normal_stiffness;
        block.shear_stiffness_times_step[lane] = p.shear_stiffness_times_step;
        block.friction[lane] = p.friction;
        block.tensile_strength[lane] = c.bonded[row] ? c.tensile_strength[row] : not_bonded;
        block.shear_strength[lane] = c.shear_strength[row];
        furthest = std::max(furthest, c.second[row] - c.first[row]);
        bonded_ |= c.bonded[row] != 0;
        frictional_ |= p.friction > 0.0f;
        block.first[lane] = numbers(c.first[row]);
        block.second[lane] = numbers(c.second[row]);
        to.rows[to.rows.size() - 8 + lane] = static_cast<std::int32_t>(row);
        lane = (lane + 1) % 8;
    };
    for (Blocks* blocks : {&strip.inner, &strip.boundary}) {
        blocks->blocks.clear();
        blocks->rows.clear();
    }
    strip.tiles.clear();
    std::size_t boundary_lane = 0;
    for (std::size_t begin = strip.first_disc; begin < strip.end_disc; begin += tile_discs) {
        const std::size_t end = std::min(begin + tile_discs, strip.end_disc);
        std::size_t lane = 0;
        for (; row < c.first.size() && static_cast<std::size_t>(c.first[row]) < end; ++row)
            if (static_cast<std::size_t>(c.second[row]) < strip.end_disc)
                append(strip.inner, lane);
            else
                append(strip.boundary, boundary_lane);
        strip.tiles.push_back({strip.inner.blocks.size(), (end + group_discs - 1) / group_discs});
    }
    strip.look_ahead = static_cast<std::size_t>(furthest) + 2 * tile_discs;
    return row;
}

/// Gives the strip's blocks their slots, from `slot` on. Returns the slot after them.
std::size_t FastCycle::assign_slots(std::size_t slot, Strip& strip) {
    const auto assign = [&](Blocks& to, std::size_t k, std::size_t first_slot) {
        to.blocks[k].slot = static_cast<std::uint32_t>(first_slot);
        for (std::size_t lane = 0; lane < 8; ++lane)
            if (const std::int32_t row = to.rows[8 * k + lane]; row >= 0)
                slot_of_[static_cast<std::size_t>(row)] =
                    static_cast<std::uint32_t>(first_slot + stored_row(lane));
    };
    // The ring: a slot may be written again once the last disc that gathers it has moved.
    std::size_t furthest = 1, block = 0;
    for (const Tile& tile : strip.tiles)
        for (; block < tile.end_block; ++block) {
            std::size_t last_disc = 0;
            for (const std::uint32_t second : strip.inner.blocks[block].second)
                if (second / disc_numbers < strip.end_disc)
                    last_disc = std::max(last_disc, second / disc_numbers);
            const Tile& gathers = strip.tiles[(last_disc - strip.first_disc) / tile_discs];
            furthest = std::max(furthest, gathers.end_block - block);
        }
    const std::size_t ring = std::bit_ceil(8 * furthest);
    slot = (slot + 7) / 8 * 8;
    for (std::size_t k = 0; k < strip.inner.blocks.size(); ++k)
        assign(strip.inner, k, slot + 8 * k % ring);
    slot += ring;
    for (std::size_t k = 0; k < strip.boundary.blocks.size(); ++k, slot += 8)
        assign(strip.boundary, k, slot);
    return slot;
}

/// Packs the base contacts of the strip's discs, which begin at `row`, with slots from `slot` on.
/// Returns the row after them.
std::size_t FastCycle::pack_base_contacts(const State& state, std::size_t row, std::size_t slot,
                                          Strip& strip) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    const auto places =
        deforms_ ? state.base_contacts.get<double>("place") : std::span<const double>();
    strip.base_contacts.clear();
    strip.base_rows.clear();
    strip.node_contacts.clear();
    for (; row < b.disc.size() && static_cast<std::size_t>(b.disc[row]) < strip.end_disc;
         ++row, ++slot) {
        base_slot_of_[row] = static_cast<std::uint32_t>(slot);
        const Surface& surface = base_.surfaces[static_cast<std::size_t>(b.surface[row])];
        const BaseContact contact{
            b.disc[row], &surface,
            base_contact_parameters(
                base_.material, state.materials[d.material[static_cast<std::size_t>(b.disc[row])]],
                time_step_),
            b.shear_force[row], static_cast<std::uint32_t>(slot)};
        if (deforms_ && surface.follows != Follows::nothing) {
            strip.node_contacts.push_back({contact, row, places[row], {}});
        } else {
            strip.base_contacts.push_back(contact);
            strip.base_rows.push_back(row);
        }
    }
    return row;
}

/// Gathering lists. Per group of discs: how many slots come in (from the base and as second disc)
/// and go out (as first disc), then the slots, interleaved by disc; short lists are filled up with
/// the zero slot.
void FastCycle::pack_gathers(const State& state) {
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    // Incoming slots by disc, in the order of the rows; outgoing contacts are consecutive rows.
    std::vector<std::uint32_t> in_begin(discs_.size() + 1, 0), out_begin(discs_.size() + 1, 0);
    for (const std::int32_t i : b.disc)
        ++in_begin[static_cast<std::size_t>(i) + 1];
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        ++in_begin[static_cast<std::size_t>(c.second[k]) + 1];
        ++out_begin[static_cast<std::size_t>(c.first[k]) + 1];
    }
    for (std::size_t i = 0; i < discs_.size(); ++i) {
        in_begin[i + 1] += in_begin[i];
        out_begin[i + 1] += out_begin[i];
    }
    std::vector<std::uint32_t> in(in_begin.back()), next = in_begin;
    for (std::size_t k = 0; k < b.disc.size(); ++k)
        in[next[static_cast<std::size_t>(b.disc[k])]++] = base_slot_of_[k];
    for (std::size_t k = 0; k < c.first.size(); ++k)
        in[next[static_cast<std::size_t>(c.second[k])]++] = slot_of_[k];

    for (Strip& strip : strips_) {
        strip.gathers.clear();
        for (std::size_t disc = strip.first_disc; disc < strip.end_disc; disc += group_discs) {
            const std::size_t counts = strip.gathers.size();
            strip.gathers.resize(counts + 2);
            const auto interleave = [&](std::span<const std::uint32_t> slots,
                                        std::span<const std::uint32_t> begin) {
                std::uint32_t most = 0;
                for (std::size_t i = disc; i < disc + group_discs; ++i)
                    most = std::max(most, begin[i + 1] - begin[i]);
                const std::size_t start = strip.gathers.size();
                strip.gathers.resize(start + group_discs * most, 0);
                for (std::size_t m = 0; m < group_discs; ++m) {
                    std::uint32_t* to = strip.gathers.data() + start + m;
                    for (std::uint32_t k = begin[disc + m]; k < begin[disc + m + 1];
                         ++k, to += group_discs)
                        *to = static_cast<std::uint32_t>(slot_numbers * slots[k]);
                }
                return most;
            };
            strip.gathers[counts] = interleave(in, in_begin);
            strip.gathers[counts + 1] = interleave(slot_of_, out_begin);
        }
    }
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
    if (RadiusRates(state).any())
        for (std::size_t i = 0; i < disc_count_; ++i)
            d.radius[i] = discs_[i].place[3];
    if (physics_.averaging_time > 0.0) {
        const auto mean_vx = state.discs.get<float>("mean_vx");
        const auto mean_vy = state.discs.get<float>("mean_vy");
        for (std::size_t i = 0; i < disc_count_; ++i) {
            mean_vx[i] = inertia_[i].mean_velocity[0];
            mean_vy[i] = inertia_[i].mean_velocity[1];
        }
    }
    const ContactColumns c = contact_columns(state);
    const BaseContactColumns b = base_contact_columns(state);
    const auto places = deforms_ ? state.base_contacts.get<double>("place") : std::span<double>();
    const auto restore = [&](const Blocks& from) {
        for (std::size_t lane = 0; lane < from.rows.size(); ++lane)
            if (from.rows[lane] >= 0) {
                const auto k = static_cast<std::size_t>(from.rows[lane]);
                const Block& block = from.blocks[lane / 8];
                c.shear_force[k] = block.shear_force[lane % 8];
                c.bonded[k] = block.tensile_strength[lane % 8] > not_bonded;
            }
    };
    for (const Strip& strip : strips_) {
        restore(strip.inner);
        restore(strip.boundary);
        for (std::size_t k = 0; k < strip.base_contacts.size(); ++k)
            b.shear_force[strip.base_rows[k]] = strip.base_contacts[k].shear_force;
        for (const NodeContact& node_contact : strip.node_contacts) {
            b.shear_force[node_contact.row] = node_contact.contact.shear_force;
            places[node_contact.row] = node_contact.place;
        }
    }
}

} // namespace listric::dem
