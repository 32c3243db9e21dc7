#include "dem/ranks/subdomain_update.hpp"

#include "dem/columns.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/ranks/table_bytes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace listric::dem {

namespace {

/// How far to the left and right discs reach in a slab of depth, m.
struct Interval {
    double left = std::numeric_limits<double>::infinity();
    double right = -std::numeric_limits<double>::infinity();

    void add(const Interval& other) {
        left = std::min(left, other.left);
        right = std::max(right, other.right);
    }
    bool is_near(double x, double distance) const {
        return x >= left - distance && x <= right + distance;
    }
};

/// Where the own discs of a subdomain are.
class Outline {
public:
    /// @param height  of a slab, m, if that makes no more slabs than discs
    Outline(const Subdomain& subdomain, double height) {
        const ConstDiscColumns d = disc_columns(subdomain.state);
        Interval y;
        for (std::size_t k = 0; k < d.y.size(); ++k)
            if (subdomain.own[k])
                y.add({d.y[k], d.y[k]});
        if (y.left > y.right)
            return; // there are none
        bottom_ = y.left;
        per_height_ = 1.0 / std::max(height, (y.right - y.left) / static_cast<double>(d.y.size()));
        slabs_.resize(static_cast<std::size_t>(slab_of(y.right)) + 1);
        for (std::size_t k = 0; k < d.y.size(); ++k)
            if (subdomain.own[k])
                slabs_[static_cast<std::size_t>(slab_of(d.y[k]))].add({d.x[k], d.x[k]});
        add_up();
    }

    explicit Outline(BytesIn from)
        : bottom_(from.take<double>()), per_height_(from.take<double>()),
          slabs_(from.take_all<Interval>()) {
        add_up();
    }
    Bytes message() const {
        BytesOut to;
        to.add(bottom_);
        to.add(per_height_);
        to.add(slabs_);
        return to.take();
    }

    /// Whether a disc may be within a distance, m.
    bool is_near(Point p, double distance) const {
        if (!all_.is_near(p.x, distance))
            return false;
        const std::int64_t first = std::max<std::int64_t>(slab_of(p.y - distance), 0);
        const std::int64_t end =
            std::min(slab_of(p.y + distance) + 1, static_cast<std::int64_t>(slabs_.size()));
        for (std::int64_t k = first; k < end; ++k)
            if (slabs_[static_cast<std::size_t>(k)].is_near(p.x, distance))
                return true;
        return false;
    }

private:
    std::int64_t slab_of(double y) const {
        return static_cast<std::int64_t>(std::floor((y - bottom_) * per_height_));
    }
    void add_up() {
        for (const Interval& slab : slabs_)
            all_.add(slab);
    }

    double bottom_ = 0.0, per_height_ = 1.0; ///< m, slabs per m
    std::vector<Interval> slabs_;
    Interval all_;
};

/// A disc at its place, m.
struct Round {
    double x, y, radius;
};

std::vector<Round> rounds_of(const Table& discs, std::span<const std::int32_t> rows) {
    const auto x = discs.get(columns::x), y = discs.get(columns::y);
    const auto radius = discs.get(columns::radius);
    std::vector<Round> rounds;
    for (const std::int32_t row : rows) {
        const auto k = static_cast<std::size_t>(row);
        rounds.push_back({x[k], y[k], radius[k]});
    }
    return rounds;
}

/// Numbers of those discs that are less than a gap, m, from one of `others`. From either side it is
/// the same pairs.
std::vector<std::int32_t> those_near(std::span<const Round> discs, std::vector<Round> others,
                                     double gap) {
    std::ranges::sort(others, {}, &Round::y);
    double largest = 0.0;
    for (const Round& other : others)
        largest = std::max(largest, other.radius);
    std::vector<std::int32_t> chosen;
    for (std::size_t k = 0; k < discs.size(); ++k) {
        const Round& a = discs[k];
        const double most = 1.001 * (a.radius + largest + gap);
        for (auto b = std::ranges::lower_bound(others, a.y - most, {}, &Round::y);
             b != others.end() && b->y <= a.y + most; ++b) {
            const double dx = a.x - b->x, dy = a.y - b->y, reach = (a.radius + b->radius) + gap;
            if (dx * dx + dy * dy < reach * reach) {
                chosen.push_back(static_cast<std::int32_t>(k));
                break;
            }
        }
    }
    return chosen;
}

/// Discs of one rank that another may have to list: rows in the whole, and all columns.
struct Candidates {
    std::vector<std::int32_t> in_whole;
    Table discs;
};

Bytes packed(const Candidates& candidates) {
    BytesOut to;
    to.add(candidates.in_whole);
    add_table(candidates.discs, to);
    return to.take();
}

Candidates candidates_in(const Bytes& message) {
    BytesIn from(message);
    Candidates candidates;
    candidates.in_whole = from.take_all<std::int32_t>();
    candidates.discs = take_table(from);
    return candidates;
}

/// Discs of one other rank and this one that are near each other.
struct Border {
    std::vector<std::int32_t> near; ///< rows of own discs
    std::vector<std::int32_t> told; ///< those that are no ghosts there
    Candidates heard;               ///< of the other's, those that are no ghosts here
};

std::vector<Border> exchange_candidates(const Subdomain& subdomain, double distance, Ranks& ranks) {
    const ConstDiscColumns d = disc_columns(subdomain.state);
    const Bytes outline = Outline(subdomain, distance).message();
    const std::vector<Bytes> outlines =
        ranks.all_to_all(std::vector<Bytes>(static_cast<std::size_t>(ranks.count()), outline));
    std::vector<Border> borders(outlines.size());
    std::vector<Bytes> messages(outlines.size());
    const auto mine = static_cast<std::size_t>(ranks.mine());
    for (std::size_t other = 0; other < borders.size(); ++other) {
        if (other == mine)
            continue;
        Border& border = borders[other];
        const Outline there{BytesIn(outlines[other])};
        for (std::size_t k = 0; k < d.x.size(); ++k)
            if (subdomain.own[k] && there.is_near({d.x[k], d.y[k]}, distance))
                border.near.push_back(static_cast<std::int32_t>(k));
        std::ranges::set_difference(border.near, subdomain.sent[other],
                                    std::back_inserter(border.told));
        Candidates told{{}, selected(subdomain.state.discs, border.told)};
        for (const std::int32_t row : border.told)
            told.in_whole.push_back(subdomain.rows[static_cast<std::size_t>(row)]);
        messages[other] = packed(told);
    }
    messages = ranks.all_to_all(std::move(messages));
    for (std::size_t other = 0; other < borders.size(); ++other)
        if (other != mine)
            borders[other].heard = candidates_in(messages[other]);
    return borders;
}

template <class T> void reorder(std::vector<T>& values, std::span<const std::int32_t> order) {
    std::vector<T> ordered;
    ordered.reserve(order.size());
    for (const std::int32_t row : order)
        ordered.push_back(values[static_cast<std::size_t>(row)]);
    values = std::move(ordered);
}

/// Puts discs that have come last into the order of the whole.
void sort_by_rows(Subdomain& subdomain) {
    std::vector<std::int32_t> order(subdomain.rows.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(
        order, {}, [&](std::int32_t row) { return subdomain.rows[static_cast<std::size_t>(row)]; });
    std::vector<std::int32_t> place(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
        place[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
    reorder_discs(subdomain.state, order);
    reorder(subdomain.rows, order);
    reorder(subdomain.own, order);
    for (auto* by_rank : {&subdomain.sent, &subdomain.received})
        for (auto& rows : *by_rank)
            for (std::int32_t& row : rows)
                row = place[static_cast<std::size_t>(row)];
}

/// Makes ghosts of the discs that have come near, here and, by the same reckoning, there. Returns
/// whether any have.
/// @param gap  between two discs, m
bool add_ghosts(Subdomain& subdomain, std::span<const Border> borders, double gap) {
    bool any = false;
    for (std::size_t other = 0; other < borders.size(); ++other) {
        const Border& border = borders[other];
        if (border.told.empty() && border.heard.in_whole.empty())
            continue;
        std::vector<std::int32_t>&sent = subdomain.sent[other],
        &received = subdomain.received[other];
        std::vector<std::int32_t> all(border.heard.in_whole.size());
        std::iota(all.begin(), all.end(), 0);
        const std::vector<Round> heard = rounds_of(border.heard.discs, all);
        std::vector<Round> theirs = rounds_of(subdomain.state.discs, received);
        theirs.insert(theirs.end(), heard.begin(), heard.end());
        for (const std::int32_t k :
             those_near(rounds_of(subdomain.state.discs, border.told), theirs, gap)) {
            sent.push_back(border.told[static_cast<std::size_t>(k)]);
            any = true;
        }
        const auto come = those_near(heard, rounds_of(subdomain.state.discs, border.near), gap);
        for (const std::int32_t k : come) {
            received.push_back(static_cast<std::int32_t>(subdomain.rows.size()));
            subdomain.rows.push_back(border.heard.in_whole[static_cast<std::size_t>(k)]);
            subdomain.own.push_back(0);
            any = true;
        }
        append_rows(selected(border.heard.discs, come), subdomain.state.discs);
    }
    return any;
}

/// Loads of the others' discs on the base are theirs to add up.
void drop_base_contacts_of_ghosts(Subdomain& subdomain) {
    const auto disc = base_contact_columns(std::as_const(subdomain.state)).disc;
    std::vector<std::int32_t> kept;
    for (std::size_t k = 0; k < disc.size(); ++k)
        if (subdomain.own[static_cast<std::size_t>(disc[k])])
            kept.push_back(static_cast<std::int32_t>(k));
    if (kept.size() < disc.size())
        subdomain.state.base_contacts.reorder(kept);
}

/// Radius of the largest disc of all ranks, m.
double largest_radius(const State& state, Ranks& ranks) {
    double largest = 0.0;
    for (const double radius : disc_columns(state).radius)
        largest = std::max(largest, radius);
    return greatest(ranks, largest);
}

} // namespace

bool update_subdomain(Subdomain& subdomain, const RigidBase& base, Ranks& ranks) {
    // Discs are listed by their searched places, from which they are a fifth of the skin away.
    const double gap = 1.5 * subdomain.state.skin;
    const double distance = 2.0 * largest_radius(subdomain.state, ranks) + gap;
    std::vector<Border> borders = exchange_candidates(subdomain, distance, ranks);
    const std::size_t before = subdomain.rows.size();
    const bool linked = add_ghosts(subdomain, borders, gap);
    if (subdomain.rows.size() > before)
        sort_by_rows(subdomain);
    for (auto* by_rank : {&subdomain.sent, &subdomain.received})
        for (auto& rows : *by_rank)
            std::ranges::sort(rows);
    update_contacts(subdomain.state, base);
    drop_base_contacts_of_ghosts(subdomain);
    std::array<std::uint64_t, 2> all{
        std::bit_cast<std::uint64_t>(subdomain.state.displacement_bound), linked};
    ranks.greatest(all);
    subdomain.state.displacement_bound = std::bit_cast<double>(all[0]);
    return all[1] != 0;
}

} // namespace listric::dem
