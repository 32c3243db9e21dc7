// Packing: from the state's columns to the records of the fast cycle, and back.

#include "dem/columns.hpp"
#include "dem/cycle/cycle_work.hpp"
#include "dem/cycle/fast_cycle.hpp"
#include "dem/cycle/surroundings.hpp"
#include "dem/law.hpp"
#include "dem/pushes.hpp"
#include "dem/radius_rates.hpp"
#include "dem/rolling.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace listric::dem {

using namespace fast;

namespace {

/// Number of rows before the first row of a disc, in a table sorted by disc.
std::size_t rows_before(std::span<const std::int32_t> sorted, std::size_t disc) {
    return static_cast<std::size_t>(
        std::ranges::lower_bound(sorted, static_cast<std::int32_t>(disc)) - sorted.begin());
}

/// Empties a list for about `size` values. Where there is no room the old list goes before the new
/// one comes, with some more room than that, so that later lists seldom need another: what grows by
/// doubling takes up to three times its memory while it does.
template <class List> void clear_for(List& list, std::size_t size) {
    list.clear();
    if (list.capacity() >= size)
        return;
    list = List();
    list.reserve(size + size / 16);
}

} // namespace

template <class Work> void FastCycle::for_each_strip(Work&& work) {
    in_pieces(strips_.size(), 1, [&](std::size_t k, std::size_t end) {
        for (; k < end; ++k)
            work(strips_[k]);
    });
}

void FastCycle::pack(const State& state, const RigidBase& base, const CyclePhysics& physics,
                     const Halo* halo) {
    base_ = &base;
    physics_ = physics;
    time_step_ = state.clock.time_step;
    deforms_ = state.base_nodes.rows() > 0;
    disc_count_ = state.discs.rows();
    // Whole groups, and two discs far from everything for the idle lanes of a block.
    const std::size_t padded = (disc_count_ + group_discs - 1) / group_discs * group_discs;
    discs_.resize(padded + 2);
    inertia_.resize(padded);
    searched_places_.resize(disc_count_);
    for (std::size_t i = disc_count_; i < padded + 2; ++i)
        discs_[i] = Disc{{0.0, 0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, 0.0}};
    discs_[padded].place[0] = -1e30;
    discs_[padded + 1].place[0] = 1e30;
    std::fill(inertia_.begin() + static_cast<std::ptrdiff_t>(disc_count_), inertia_.end(),
              Inertia{});
    divide_work(state, halo);
    pack_discs(state);
    pack_searched_places(state);
    pack_contacts(state);
}

void FastCycle::pack_discs(const State& state) {
    for_each_strip([&](const Strip& strip) { pack_discs(state, strip); });
}

void FastCycle::pack_updated(const State& state, bool lists_changed, const Halo* halo) {
    if (state.discs.rows() != disc_count_)
        return pack(state, *base_, physics_, halo);
    if (lists_changed)
        pack_contacts(state);
    pack_searched_places(state);
}

void FastCycle::pack_discs(const State& state, const Strip& strip) {
    const ConstDiscColumns d = disc_columns(state);
    const RadiusRates radii(state);
    for (std::size_t i = strip.first_disc; i < strip.end_disc; ++i) {
        discs_[i] = {{d.x[i], d.y[i], d.rotation[i], d.radius[i]},
                     {d.vx[i], d.vy[i], d.spin[i], radii[i]}};
        const double acceleration_per_force =
            time_step_ / std::max(d.mass[i], state.inertial_mass_floor);
        const double radius = radii.of_inertia(i, d.radius[i]);
        inertia_[i] = {acceleration_per_force,
                       d.mass[i] * physics_.gravity,
                       acceleration_per_force * (2.0 / (radius * radius)),
                       {}};
    }
    if (physics_.averaging_time > 0.0) {
        const auto mean_vx = state.discs.get(columns::mean_vx);
        const auto mean_vy = state.discs.get(columns::mean_vy);
        for (std::size_t i = strip.first_disc; i < strip.end_disc; ++i)
            std::ranges::copy(std::array{mean_vx[i], mean_vy[i]}, inertia_[i].mean_velocity);
    }
}

/// Gives each strip whole tiles of about equal work. Large packings are cut into some strips a
/// thread, so that a thread which is late holds up little; small ones are not, for contacts between
/// strips cost more than others.
void FastCycle::divide_work(const State& state, const Halo* halo) {
    if (halo && threads_ == 1)
        return cut_off_borders(*halo);
    constexpr std::size_t large = 2500; // discs of a strip
    const std::span<const std::int32_t> first = contact_columns(state).first;
    const std::span<const std::int32_t> base_disc = base_contact_columns(state).disc;
    const auto work_before = [&](std::size_t disc) {
        return disc_work * disc + contact_work * rows_before(first, disc) +
               base_contact_work * rows_before(base_disc, disc);
    };
    const std::size_t tiles = (disc_count_ + tile_discs - 1) / tile_discs;
    const auto threads = static_cast<std::size_t>(threads_);
    const std::size_t a_thread =
        threads == 1 ? 1 : std::clamp<std::size_t>(disc_count_ / (large * threads), 1, 4);
    strips_.resize(std::clamp<std::size_t>(threads * a_thread, 1, std::max<std::size_t>(tiles, 1)));
    std::size_t tile = 0;
    for (std::size_t s = 0; s < strips_.size(); ++s) {
        const std::size_t goal = work_before(disc_count_) * (s + 1) / strips_.size();
        strips_[s].first_disc = std::min(tile * tile_discs, disc_count_);
        while (tile < tiles && work_before(tile * tile_discs) +
                                       work_before(std::min((tile + 1) * tile_discs, disc_count_)) <
                                   2 * goal)
            ++tile;
        strips_[s].end_disc = std::min(tile * tile_discs, disc_count_);
    }
}

/// Cuts three strips; the first and the last hold all discs that are sent and all ghosts, on either
/// side of the middle row.
void FastCycle::cut_off_borders(const Halo& halo) {
    const std::size_t middle = disc_count_ / 2 / tile_discs * tile_discs;
    std::size_t low = 0, high = disc_count_;
    const auto cut_off = [&](std::size_t row) {
        const std::size_t tile = row / tile_discs * tile_discs;
        if (tile < middle)
            low = std::max(low, tile + tile_discs);
        else
            high = std::min(high, tile);
    };
    for (const auto* rows : {&halo.sent, &halo.received})
        for (const std::int32_t row : *rows)
            cut_off(static_cast<std::size_t>(row));
    strips_.resize(3);
    const std::size_t ends[] = {low, high, disc_count_};
    for (std::size_t s = 0; s < 3; ++s) {
        strips_[s].first_disc = s == 0 ? 0 : ends[s - 1];
        strips_[s].end_disc = ends[s];
    }
}

void FastCycle::pack_searched_places(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    in_pieces(disc_count_, 16384, [&](std::size_t i, std::size_t end) {
        for (; i < end; ++i)
            searched_places_[i] = {d.searched_x[i], d.searched_y[i]};
    });
}

void FastCycle::pack_contacts(const State& state) {
    rolls_ = resists_rolling(state);
    slot_of_.resize(state.contacts.rows());
    base_slot_of_.resize(state.base_contacts.rows());
    const std::span<const std::int32_t> first = contact_columns(state).first;
    const std::span<const std::int32_t> base_disc = base_contact_columns(state).disc;
    for_each_strip([&](Strip& strip) {
        strip.first_row = rows_before(first, strip.first_disc);
        strip.end_row = rows_before(first, strip.end_disc);
        strip.first_base_row = rows_before(base_disc, strip.first_disc);
        strip.end_base_row = rows_before(base_disc, strip.end_disc);
        pack_blocks(state, strip);
    });
    bonded_ = frictional_ = false;
    const Pushes pushes(state);
    std::size_t slot = 1; // slot 0 stays zero
    for (Strip& strip : strips_) {
        bonded_ |= strip.bonded;
        frictional_ |= strip.frictional;
        strip.first_slot = (slot + 7) / 8 * 8;
        strip.first_push_slot = strip.first_slot + strip.ring + 8 * strip.boundary.blocks.size() +
                                strip.end_base_row - strip.first_base_row;
        slot = strip.first_push_slot + pushes.count(strip.first_disc, strip.end_disc);
    }
    slots_.resize(slot);
    slots_[0] = {};
    for_each_strip([&](Strip& strip) {
        assign_slots(strip);
        pack_base_contacts(state, strip);
    });
    for_each_strip([&](Strip& strip) { pack_gathers(state, strip); });
}

/// Fills the strip's blocks with the contacts of its discs.
void FastCycle::pack_blocks(const State& state, Strip& strip) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const PairParameters pairs(state.materials, time_step_);
    const auto rolling = rolling_moments(state.contacts);
    const auto numbers = [](auto disc) {
        return static_cast<std::uint32_t>(disc_numbers * static_cast<std::size_t>(disc));
    };
    const std::size_t idle = discs_.size() - 2;
    strip.bonded = strip.frictional = false;
    std::size_t row = strip.first_row;
    std::int32_t furthest = 0; // second disc from the first
    const auto append = [&](Blocks& to, std::size_t& lane) {
        if (lane == 0) {
            Block& block = to.blocks.emplace_back(); // zeros
            std::ranges::fill(block.tensile_strength, not_bonded);
            std::ranges::fill(block.first, numbers(idle));
            std::ranges::fill(block.second, numbers(idle + 1));
            to.rows.resize(to.rows.size() + 8, -1);
            if (rolls_)
                to.rolling.emplace_back();
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
        if (rolls_) {
            to.rolling.back().moment[lane] = rolling[row];
            to.rolling.back().friction[lane] = p.rolling_friction;
        }
        furthest = std::max(furthest, c.second[row] - c.first[row]);
        strip.bonded |= c.bonded[row] != 0;
        strip.frictional |= p.friction > 0.0f;
        block.first[lane] = numbers(c.first[row]);
        block.second[lane] = numbers(c.second[row]);
        to.rows[to.rows.size() - 8 + lane] = static_cast<std::int32_t>(row);
        lane = (lane + 1) % 8;
    };
    const std::size_t tiles = strip.disc_count() / tile_discs + 1;
    const std::size_t blocks = (strip.end_row - strip.first_row) / 8 + tiles;
    clear_for(strip.inner.blocks, blocks);
    clear_for(strip.inner.rows, 8 * blocks);
    clear_for(strip.inner.rolling, rolls_ ? blocks : 0);
    strip.boundary.blocks.clear();
    strip.boundary.rolling.clear();
    strip.boundary.rows.clear();
    strip.tiles.clear();
    std::size_t boundary_lane = 0;
    for (std::size_t begin = strip.first_disc; begin < strip.end_disc; begin += tile_discs) {
        const std::size_t end = std::min(begin + tile_discs, strip.end_disc);
        std::size_t lane = 0;
        for (; row < strip.end_row && static_cast<std::size_t>(c.first[row]) < end; ++row)
            if (static_cast<std::size_t>(c.second[row]) < strip.end_disc)
                append(strip.inner, lane);
            else
                append(strip.boundary, boundary_lane);
        strip.tiles.push_back({strip.inner.blocks.size(), (end + group_discs - 1) / group_discs});
    }
    strip.look_ahead = static_cast<std::size_t>(furthest) + 2 * tile_discs;
    strip.ring = ring_of(strip);
}

/// Gives the strip's blocks their slots.
void FastCycle::assign_slots(Strip& strip) {
    const auto assign = [&](Blocks& to, std::size_t k, std::size_t first_slot) {
        to.blocks[k].slot = static_cast<std::uint32_t>(first_slot);
        for (std::size_t lane = 0; lane < 8; ++lane)
            if (const std::int32_t row = to.rows[8 * k + lane]; row >= 0)
                slot_of_[static_cast<std::size_t>(row)] =
                    static_cast<std::uint32_t>(first_slot + stored_row(lane));
    };
    for (std::size_t k = 0; k < strip.inner.blocks.size(); ++k)
        assign(strip.inner, k, strip.first_slot + 8 * k % strip.ring);
    for (std::size_t k = 0; k < strip.boundary.blocks.size(); ++k)
        assign(strip.boundary, k, strip.first_slot + strip.ring + 8 * k);
}

/// Slots that the strip's inner blocks share in a ring: a slot may be written again once the last
/// disc that gathers it has moved.
std::size_t FastCycle::ring_of(const Strip& strip) {
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
    return std::bit_ceil(8 * furthest);
}

/// Packs the base contacts of the strip's discs, and their pushes: those slots follow the blocks'.
void FastCycle::pack_base_contacts(const State& state, Strip& strip) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    const auto places =
        deforms_ ? state.base_contacts.get(columns::place) : std::span<const double>();
    strip.base_contacts.clear();
    strip.base_rows.clear();
    strip.node_contacts.clear();
    strip.base_rolling.clear();
    strip.node_rolling.clear();
    const auto rolling = rolling_moments(state.base_contacts);
    std::size_t slot = strip.first_slot + strip.ring + 8 * strip.boundary.blocks.size();
    for (std::size_t row = strip.first_base_row; row < strip.end_base_row; ++row, ++slot) {
        base_slot_of_[row] = static_cast<std::uint32_t>(slot);
        const Surface& surface = base_->surfaces[static_cast<std::size_t>(b.surface[row])];
        const BaseContact contact{
            b.disc[row], &surface,
            base_contact_parameters(
                base_->material, state.materials[d.material[static_cast<std::size_t>(b.disc[row])]],
                time_step_),
            b.shear_force[row], static_cast<std::uint32_t>(slot)};
        const bool on_nodes = deforms_ && surface.follows != Follows::nothing;
        if (rolls_)
            (on_nodes ? strip.node_rolling : strip.base_rolling).push_back(rolling[row]);
        if (on_nodes) {
            strip.node_contacts.push_back({contact, row, places[row], {}});
        } else {
            strip.base_contacts.push_back(contact);
            strip.base_rows.push_back(row);
        }
    }
    slot = strip.first_push_slot;
    if (const Pushes pushes(state); pushes.any())
        for (std::size_t i = strip.first_disc; i < strip.end_disc; ++i)
            if (pushes.on(i))
                slots_[slot++] = Slot{pushes[i].x, pushes[i].y, 0.0, 0.0};
}

/// Gathering lists. Per group of discs: how many slots beyond the usual ones come in (of the push,
/// which nothing writes again, from the base and as second disc) and go out (as first disc), then
/// the slots, interleaved by disc; short lists are filled up with the zero slot.
void FastCycle::pack_gathers(const State& state, Strip& strip) {
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    const std::size_t groups = (strip.disc_count() + group_discs - 1) / group_discs;
    const Pushes pushes(state);
    // Incoming slots by disc, in the order of the rows: earlier strips reach into this one by their
    // boundaries. Outgoing contacts are consecutive rows.
    const auto for_each_incoming = [&](auto&& visit) {
        auto push_slot = static_cast<std::uint32_t>(strip.first_push_slot);
        if (pushes.any())
            for (std::size_t i = strip.first_disc; i < strip.end_disc; ++i)
                if (pushes.on(i))
                    visit(static_cast<std::int32_t>(i), push_slot++);
        for (std::size_t row = strip.first_base_row; row < strip.end_base_row; ++row)
            visit(b.disc[row], base_slot_of_[row]);
        const auto visit_contact = [&](std::size_t row) {
            const auto second = static_cast<std::size_t>(c.second[row]);
            if (strip.first_disc <= second && second < strip.end_disc)
                visit(c.second[row], slot_of_[row]);
        };
        for (const Strip* earlier = strips_.data(); earlier != &strip; ++earlier)
            for (const std::int32_t row : earlier->boundary.rows)
                if (row >= 0)
                    visit_contact(static_cast<std::size_t>(row));
        for (std::size_t row = strip.first_row; row < strip.end_row; ++row)
            visit_contact(row);
    };
    const auto place_of = [&](std::int32_t disc) {
        return static_cast<std::size_t>(disc) - strip.first_disc;
    };
    std::vector<std::uint32_t> in_begin(groups * group_discs + 1, 0), out_begin = in_begin;
    for_each_incoming([&](std::int32_t disc, std::uint32_t) { ++in_begin[place_of(disc) + 1]; });
    for (std::size_t row = strip.first_row; row < strip.end_row; ++row)
        ++out_begin[place_of(c.first[row]) + 1];
    std::partial_sum(in_begin.begin(), in_begin.end(), in_begin.begin());
    std::partial_sum(out_begin.begin(), out_begin.end(), out_begin.begin());
    std::vector<std::uint32_t> in(in_begin.back()), next = in_begin;
    for_each_incoming(
        [&](std::int32_t disc, std::uint32_t slot) { in[next[place_of(disc)]++] = slot; });
    const auto out = std::span(slot_of_).subspan(strip.first_row, strip.end_row - strip.first_row);

    clear_for(strip.gathers, groups * (2 + 2 * group_discs * usual_slots));
    for (std::size_t disc = 0; disc < groups * group_discs; disc += group_discs) {
        const std::size_t counts = strip.gathers.size();
        strip.gathers.resize(counts + 2);
        const auto interleave = [&](std::span<const std::uint32_t> slots,
                                    std::span<const std::uint32_t> begin) {
            std::uint32_t most = usual_slots;
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
            return most - usual_slots;
        };
        strip.gathers[counts] = interleave(in, in_begin);
        strip.gathers[counts + 1] = interleave(out, out_begin);
    }
}

void FastCycle::unpack(State& state) {
    for_each_strip([&](const Strip& strip) { unpack(strip, state); });
}

void FastCycle::unpack(const Strip& strip, State& state) const {
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = strip.first_disc; i < strip.end_disc; ++i) {
        const Disc& disc = discs_[i];
        d.x[i] = disc.place[0];
        d.y[i] = disc.place[1];
        d.rotation[i] = disc.place[2];
        d.vx[i] = disc.velocity[0];
        d.vy[i] = disc.velocity[1];
        d.spin[i] = disc.velocity[2];
    }
    if (RadiusRates(state).any())
        for (std::size_t i = strip.first_disc; i < strip.end_disc; ++i)
            d.radius[i] = discs_[i].place[3];
    if (physics_.averaging_time > 0.0) {
        const auto mean_vx = state.discs.get(columns::mean_vx);
        const auto mean_vy = state.discs.get(columns::mean_vy);
        for (std::size_t i = strip.first_disc; i < strip.end_disc; ++i) {
            mean_vx[i] = inertia_[i].mean_velocity[0];
            mean_vy[i] = inertia_[i].mean_velocity[1];
        }
    }
    const ContactColumns c = contact_columns(state);
    const BaseContactColumns b = base_contact_columns(state);
    const auto places = deforms_ ? state.base_contacts.get(columns::place) : std::span<double>();
    const std::span<double> rolling = rolling_moments(state.contacts);
    for (const Blocks* from : {&strip.inner, &strip.boundary})
        for (std::size_t lane = 0; lane < from->rows.size(); ++lane)
            if (from->rows[lane] >= 0) {
                const auto k = static_cast<std::size_t>(from->rows[lane]);
                const Block& block = from->blocks[lane / 8];
                c.shear_force[k] = block.shear_force[lane % 8];
                c.bonded[k] = block.tensile_strength[lane % 8] > not_bonded;
                if (rolls_)
                    rolling[k] = from->rolling[lane / 8].moment[lane % 8];
            }
    for (std::size_t k = 0; k < strip.base_contacts.size(); ++k)
        b.shear_force[strip.base_rows[k]] = strip.base_contacts[k].shear_force;
    for (const NodeContact& node_contact : strip.node_contacts) {
        b.shear_force[node_contact.row] = node_contact.contact.shear_force;
        places[node_contact.row] = node_contact.place;
    }
    if (!rolls_)
        return;
    const std::span<double> base_rolling = rolling_moments(state.base_contacts);
    for (std::size_t k = 0; k < strip.base_contacts.size(); ++k)
        base_rolling[strip.base_rows[k]] = strip.base_rolling[k];
    for (std::size_t k = 0; k < strip.node_contacts.size(); ++k)
        base_rolling[strip.node_contacts[k].row] = strip.node_rolling[k];
}

} // namespace listric::dem
