#include "dem/share_update.hpp"

#include "dem/contacts.hpp"
#include "dem/table_bytes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace listric::dem {

namespace {

/// How far to the left and right discs reach in a slab of depth, m.
struct Interval {
    std::int64_t slab;
    double left, right;
};

/// Where the own discs of a share are.
class Outline {
public:
    /// @param height  of a slab, m
    explicit Outline(double height) : height_(height) {}
    Outline(double height, std::span<const Interval> intervals) : height_(height) {
        for (const Interval& interval : intervals)
            by_slab_[interval.slab] = {interval.left, interval.right};
    }

    void add(Point p) {
        const auto [at, is_new] = by_slab_.try_emplace(slab_of(p.y), p.x, p.x);
        auto& [left, right] = at->second;
        left = std::min(left, p.x);
        right = std::max(right, p.x);
    }

    /// Whether a disc may be within a distance, m.
    bool is_near(Point p, double distance) const {
        const std::int64_t last = slab_of(p.y + distance);
        for (auto at = by_slab_.lower_bound(slab_of(p.y - distance));
             at != by_slab_.end() && at->first <= last; ++at)
            if (p.x >= at->second.first - distance && p.x <= at->second.second + distance)
                return true;
        return false;
    }

    std::vector<Interval> intervals() const {
        std::vector<Interval> list;
        for (const auto& [slab, sides] : by_slab_)
            list.push_back({slab, sides.first, sides.second});
        return list;
    }

private:
    std::int64_t slab_of(double y) const {
        return static_cast<std::int64_t>(std::floor(y / height_));
    }

    double height_;
    std::map<std::int64_t, std::pair<double, double>> by_slab_;
};

/// Distance within which two discs may come to be listed, m: by their searched places, from which
/// they are less than half a skin away.
double reach_of(const State& state, Ranks& ranks) {
    const ConstDiscColumns d = disc_columns(state);
    double largest = 0.0;
    for (const double radius : d.radius)
        largest = std::max(largest, radius);
    return 2.0 * greatest(ranks, largest) + 2.0 * state.skin;
}

std::vector<Outline> outlines_of_all(const Share& share, double reach, Ranks& ranks) {
    const ConstDiscColumns d = disc_columns(share.state);
    Outline mine(reach);
    for (std::size_t k = 0; k < d.x.size(); ++k)
        if (share.own[k])
            mine.add({d.x[k], d.y[k]});
    BytesOut letter;
    letter.add(mine.intervals());
    std::vector<Outline> outlines;
    for (const Bytes& other :
         ranks.trade(std::vector<Bytes>(static_cast<std::size_t>(ranks.count()), letter.take())))
        outlines.emplace_back(reach, BytesIn(other).take_all<Interval>());
    return outlines;
}

/// Own discs that another rank may have to list and does not have yet.
Bytes discs_for(std::size_t rank, const Share& share, const Outline& outline, double reach) {
    const ConstDiscColumns d = disc_columns(share.state);
    std::vector<std::int32_t> rows, in_whole;
    auto sent = share.sent[rank].begin();
    for (std::size_t k = 0; k < d.x.size(); ++k) {
        const auto row = static_cast<std::int32_t>(k);
        if (sent != share.sent[rank].end() && *sent == row) {
            ++sent;
        } else if (share.own[k] && outline.is_near({d.x[k], d.y[k]}, reach)) {
            rows.push_back(row);
            in_whole.push_back(share.rows[k]);
        }
    }
    BytesOut letter;
    letter.add(in_whole);
    add_table(selected(share.state.discs, rows), letter);
    return letter.take();
}

/// By row of a share's discs, their ranks.
std::vector<std::int32_t> ranks_of(const Share& share, int mine) {
    std::vector<std::int32_t> rank(share.rows.size(), mine);
    for (std::size_t other = 0; other < share.received.size(); ++other)
        for (const std::int32_t row : share.received[other])
            rank[static_cast<std::size_t>(row)] = static_cast<std::int32_t>(other);
    return rank;
}

template <class T> void reorder(std::vector<T>& values, std::span<const std::int32_t> order) {
    std::vector<T> ordered;
    ordered.reserve(order.size());
    for (const std::int32_t row : order)
        ordered.push_back(values[static_cast<std::size_t>(row)]);
    values = std::move(ordered);
}

/// Keeps the discs of `order` in that order.
void reorder(Share& share, std::vector<std::int32_t>& rank, std::span<const std::int32_t> order) {
    reorder_discs(share.state, order);
    reorder(share.rows, order);
    reorder(share.own, order);
    reorder(rank, order);
}

/// Takes in, in the order of the whole, what the others have near this rank's discs.
void add_neighbours(Share& share, std::vector<std::int32_t>& rank, Ranks& ranks) {
    const double reach = reach_of(share.state, ranks);
    const std::vector<Outline> outlines = outlines_of_all(share, reach, ranks);
    std::vector<Bytes> letters(outlines.size());
    for (std::size_t other = 0; other < letters.size(); ++other)
        if (static_cast<int>(other) != ranks.mine())
            letters[other] = discs_for(other, share, outlines[other], reach);
    letters = ranks.trade(std::move(letters));
    for (std::size_t other = 0; other < letters.size(); ++other) {
        if (static_cast<int>(other) == ranks.mine())
            continue;
        BytesIn from(letters[other]);
        const auto in_whole = from.take_all<std::int32_t>();
        append_rows(take_table(from), share.state.discs);
        share.rows.insert(share.rows.end(), in_whole.begin(), in_whole.end());
        rank.resize(share.rows.size(), static_cast<std::int32_t>(other));
    }
    share.own.resize(share.rows.size(), 0);
    std::vector<std::int32_t> order(share.rows.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {},
                      [&](std::int32_t row) { return share.rows[static_cast<std::size_t>(row)]; });
    reorder(share, rank, order);
}

/// Drops what none of this rank's discs is listed with.
void drop_strangers(Share& share, std::vector<std::int32_t>& rank) {
    const auto is_own = [&](std::int32_t row) { return share.own[static_cast<std::size_t>(row)]; };
    const ConstContactColumns c = contact_columns(std::as_const(share.state));
    std::vector<std::uint8_t> needed = share.own;
    std::vector<std::int32_t> kept;
    for (std::size_t k = 0; k < c.first.size(); ++k)
        if (is_own(c.first[k]) || is_own(c.second[k])) {
            kept.push_back(static_cast<std::int32_t>(k));
            needed[static_cast<std::size_t>(c.first[k])] = 1;
            needed[static_cast<std::size_t>(c.second[k])] = 1;
        }
    share.state.contacts.reorder(kept);
    const auto disc = base_contact_columns(std::as_const(share.state)).disc;
    kept.clear();
    for (std::size_t k = 0; k < disc.size(); ++k)
        if (is_own(disc[k]))
            kept.push_back(static_cast<std::int32_t>(k));
    share.state.base_contacts.reorder(kept);
    kept.clear();
    for (std::size_t k = 0; k < needed.size(); ++k)
        if (needed[k])
            kept.push_back(static_cast<std::int32_t>(k));
    reorder(share, rank, kept);
}

/// What is sent where: own discs to the ranks of the ghosts that they are listed with, which list
/// them, too.
void connect(Share& share, const std::vector<std::int32_t>& rank) {
    const ConstContactColumns c = contact_columns(std::as_const(share.state));
    for (auto* by_rank : {&share.sent, &share.received})
        for (auto& rows : *by_rank)
            rows.clear();
    const auto add = [&](std::int32_t own, std::int32_t other) {
        const auto ghost = static_cast<std::size_t>(other);
        if (share.own[ghost])
            return;
        const auto there = static_cast<std::size_t>(rank[ghost]);
        share.sent[there].push_back(own);
        share.received[there].push_back(other);
    };
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        if (share.own[static_cast<std::size_t>(c.first[k])])
            add(c.first[k], c.second[k]);
        else
            add(c.second[k], c.first[k]);
    }
    for (auto* by_rank : {&share.sent, &share.received})
        for (auto& rows : *by_rank) {
            std::ranges::sort(rows);
            rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        }
}

} // namespace

void update_share(Share& share, const RigidBase& base, Ranks& ranks) {
    std::vector<std::int32_t> rank = ranks_of(share, ranks.mine());
    add_neighbours(share, rank, ranks);
    update_contacts(share.state, base);
    drop_strangers(share, rank);
    connect(share, rank);
    share.state.displacement_bound = greatest(ranks, share.state.displacement_bound);
}

} // namespace listric::dem
