#include "dem/contacts/contacts.hpp"

#include "dem/base/place.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/order_free.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace listric::dem {

namespace {

/// A pair to be listed: of two discs, or of disc and surface.
struct Pair {
    std::int32_t first, second;
    bool operator==(const Pair&) const = default;
    auto operator<=>(const Pair& other) const { return key() <=> other.key(); }

private:
    std::int64_t key() const { return (static_cast<std::int64_t>(first) << 32) + second; }
};

/// The discs whose pairs are searched.
struct Searched {
    std::vector<std::int32_t> rows;
    std::vector<std::uint8_t> flags; ///< by row of the disc table
};

Searched all_discs(const State& state) {
    Searched searched{{}, std::vector<std::uint8_t>(state.discs.rows(), 1)};
    searched.rows.resize(state.discs.rows());
    for (std::size_t i = 0; i < searched.rows.size(); ++i)
        searched.rows[i] = static_cast<std::int32_t>(i);
    return searched;
}

/// Result of a merge: the former row of each row, and the new pairs.
struct Merged {
    std::vector<std::int32_t> rows;
    std::vector<Pair> added;
};

/// Gives a table the rows that stay, as keeps(row) says, and `found` (sorted pairs), sorted by
/// pair. A found pair that was listed before keeps its columns, others start afresh. Returns
/// whether anything changed.
template <class Keeps>
bool merge(Table& table, const ColumnName<std::int32_t>& first_name,
           const ColumnName<std::int32_t>& second_name, std::span<const Pair> found,
           Keeps&& keeps) {
    const auto first = table.get(first_name);
    const auto second = table.get(second_name);
    const auto pair_of = [&](std::size_t k) { return Pair{first[k], second[k]}; };
    const auto new_row = static_cast<std::int32_t>(first.size());
    auto pieces = by_piece(first.size(), 4096, [&](std::size_t row, std::size_t end) {
        Merged merged;
        auto next = row == 0 ? found.begin() : std::ranges::lower_bound(found, pair_of(row));
        const auto last =
            end == first.size() ? found.end() : std::ranges::lower_bound(found, pair_of(end));
        const auto add = [&] {
            merged.rows.push_back(new_row);
            merged.added.push_back(*next++);
        };
        merged.rows.reserve(end - row + static_cast<std::size_t>(last - next));
        for (; row < end; ++row) {
            while (next != last && *next < pair_of(row))
                add();
            const bool again = next != last && *next == pair_of(row);
            if (again)
                ++next;
            if (again || keeps(row))
                merged.rows.push_back(static_cast<std::int32_t>(row));
        }
        while (next != last)
            add();
        return merged;
    });
    const std::vector<Pair> added = joined(std::span(pieces), &Merged::added);
    const std::vector<std::int32_t> rows = joined(std::span(pieces), &Merged::rows);
    if (added.empty() && rows.size() == first.size())
        return false;
    table.reorder(rows);
    const auto new_first = table.get(first_name);
    const auto new_second = table.get(second_name);
    auto pair = added.begin();
    for (std::size_t k = 0; k < rows.size(); ++k)
        if (rows[k] == new_row) {
            new_first[k] = pair->first;
            new_second[k] = pair->second;
            ++pair;
        }
    return true;
}

/// All pairs, in order. A disc has few, so they are dealt out to their first discs.
std::vector<Pair> sorted(std::span<const std::vector<Pair>> pieces, std::size_t discs) {
    std::vector<std::uint32_t> ends(discs + 1, 0); // of each disc's pairs, once they are dealt out
    for (const std::vector<Pair>& piece : pieces)
        for (const Pair& pair : piece)
            ++ends[static_cast<std::size_t>(pair.first) + 1];
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<Pair> result(ends.back());
    for (const std::vector<Pair>& piece : pieces)
        for (const Pair& pair : piece)
            result[ends[static_cast<std::size_t>(pair.first)]++] = pair;
    const auto at = [&](std::uint32_t k) {
        return result.begin() + static_cast<std::ptrdiff_t>(k);
    };
    in_pieces(discs, 8192, [&](std::size_t disc, std::size_t end) {
        for (; disc < end; ++disc)
            std::sort(at(disc == 0 ? 0 : ends[disc - 1]), at(ends[disc]));
    });
    return result;
}

/// A disc as a search sees it.
struct Candidate {
    double x, y, radius; ///< m
    std::int32_t row;
    std::uint8_t is_searched;
};

/// Discs in the order of their cells, so that a search reads memory in succession.
std::vector<Candidate> candidates_of(const ConstDiscColumns& d, const Cells& cells,
                                     const Searched& searched) {
    std::vector<Candidate> candidates(d.x.size());
    in_pieces(candidates.size(), 8192, [&](std::size_t k, std::size_t end) {
        for (; k < end; ++k) {
            const auto i = static_cast<std::size_t>(cells.discs()[k]);
            candidates[k] = {d.searched_x[i], d.searched_y[i], d.radius[i], cells.discs()[k],
                             searched.flags[i]};
        }
    });
    return candidates;
}

/// Pairs of a searched disc and another that are near each other, in no order. Of two searched
/// discs, the first by cell finds the pair.
std::vector<std::vector<Pair>> pairs_near(const State& state, const Searched& searched) {
    const ConstDiscColumns d = disc_columns(state);
    const double largest = d.x.empty() ? 0.0 : *std::ranges::max_element(d.radius);
    const Cells cells(d.searched_x, d.searched_y, 2.0 * largest + state.skin);
    const std::vector<Candidate> candidates = candidates_of(d, cells, searched);
    std::vector<std::uint32_t> not_searched(candidates.size() + 1, 0); // before each
    for (std::size_t k = 0; k < candidates.size(); ++k)
        not_searched[k + 1] = not_searched[k] + !candidates[k].is_searched;

    return by_piece(candidates.size(), 512, [&](std::size_t k, std::size_t end) {
        std::vector<Pair> found(4 * (end - k - (not_searched[end] - not_searched[k])));
        std::size_t count = 0;
        for (; k < end; ++k) {
            const Candidate& disc = candidates[k];
            if (!disc.is_searched)
                continue;
            cells.for_each_run_near(disc.x, disc.y, [&](std::size_t begin, std::size_t last) {
                if (begin <= k && not_searched[std::min(last, k)] == not_searched[begin])
                    begin = k + 1; // nothing for it to find before
                if (begin >= last)
                    return;
                if (found.size() < count + (last - begin))
                    found.resize((count + (last - begin)) * 5 / 4);
                for (; begin < last; ++begin) {
                    const Candidate& other = candidates[begin];
                    const double dx = other.x - disc.x, dy = other.y - disc.y;
                    const double reach = disc.radius + other.radius + state.skin;
                    // Without a branch: the processor would guess it wrongly.
                    const bool is_near = dx * dx + dy * dy < reach * reach;
                    const bool finds = (begin > k) | !other.is_searched;
                    found[count] = {std::min(disc.row, other.row), std::max(disc.row, other.row)};
                    count += static_cast<std::size_t>(is_near & finds);
                }
            });
        }
        found.resize(count);
        return found;
    });
}

bool find_disc_contacts(State& state, const Searched& searched) {
    const std::vector<Pair> found = sorted(pairs_near(state, searched), state.discs.rows());
    const ConstContactColumns c = contact_columns(std::as_const(state));
    return merge(state.contacts, columns::first, columns::second, found, [&](std::size_t k) {
        return c.bonded[k] || !(searched.flags[static_cast<std::size_t>(c.first[k])] ||
                                searched.flags[static_cast<std::size_t>(c.second[k])]);
    });
}

bool find_base_contacts(State& state, const RigidBase& base, const Searched& searched) {
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    const BasePlace place = searched_base_place(state);
    // The rigid chain is found faster than the deformed wall, and rules out most discs.
    const double displacement = 1.1 * greatest_node_displacement(place);
    const auto find = [&](std::size_t k, std::size_t end) {
        std::vector<Pair> found;
        for (; k < end; ++k)
            for (std::size_t s = 0; s < base.surfaces.size(); ++s) {
                const std::int32_t row = searched.rows[k];
                const auto i = static_cast<std::size_t>(row);
                const Point p{d.searched_x[i], d.searched_y[i]};
                const double reach = d.radius[i] + state.skin;
                auto foot = nearest(base.surfaces[s], state.searched_extension, p);
                if (place.deforms(base.surfaces[s]) &&
                    !(foot && foot->distance > reach + state.skin + displacement))
                    foot = nearest(base.surfaces[s], place, p);
                // Beyond an open end a surface has no foot, but a disc may come back within the
                // skin.
                if ((foot && foot->distance <= reach) ||
                    is_near_end(base.surfaces[s], place, p, reach))
                    found.push_back({row, static_cast<std::int32_t>(s)});
            }
        return found;
    };
    const std::vector<Pair> found = joined(by_piece(searched.rows.size(), 512, find));
    const ConstBaseContactColumns c = base_contact_columns(std::as_const(state));
    return merge(state.base_contacts, columns::disc, columns::surface, found, [&](std::size_t k) {
        return !searched.flags[static_cast<std::size_t>(c.disc[k])];
    });
}

template <class Columns> double displacement_square(const Columns& d, std::size_t i) {
    const double dx = d.x[i] - d.searched_x[i], dy = d.y[i] - d.searched_y[i];
    return dx * dx + dy * dy;
}

/// From now on all surfaces were found where they are.
void mark_surfaces(State& state) {
    state.searched_extension = state.clock.extension.m;
    const BaseNodeColumns n = base_node_columns(state);
    std::ranges::copy(n.ux, n.searched_ux.begin());
    std::ranges::copy(n.uy, n.searched_uy.begin());
}

} // namespace

double surface_travel(const State& state, const RigidBase& base, double extension) {
    const double translation =
        greatest_translation(base) * std::abs(extension - state.searched_extension);
    return greater(translation, greatest_node_travel(state));
}

void find_contacts(State& state, const RigidBase& base) {
    const DiscColumns d = disc_columns(state);
    std::ranges::copy(d.x, d.searched_x.begin());
    std::ranges::copy(d.y, d.searched_y.begin());
    refuse_displaced(state); // discs that are nowhere
    mark_surfaces(state);
    state.displacement_bound = state.window_speed = 0.0;
    state.check_interval = 1;
    const Searched searched = all_discs(state);
    find_disc_contacts(state, searched);
    find_base_contacts(state, base, searched);
}

double greatest_displacement(const State& state, const RigidBase& base) {
    const ConstDiscColumns d = disc_columns(state);
    double greatest = 0.0;
    for (const double of_piece : by_piece(d.x.size(), 16384, [&](std::size_t i, std::size_t end) {
             double most = 0.0;
             for (; i < end; ++i)
                 most = greater(most, displacement_square(d, i));
             return most;
         }))
        greatest = greater(greatest, of_piece);
    return greater(std::sqrt(greatest), surface_travel(state, base, state.clock.extension.m));
}

void find_surface_contacts(State& state, const RigidBase& base) {
    mark_surfaces(state);
    find_base_contacts(state, base, all_discs(state));
}

bool update_contacts(State& state, const RigidBase& base) {
    const DiscColumns d = disc_columns(state);
    const double stays = 0.2 * state.skin;
    Searched searched{{}, std::vector<std::uint8_t>(d.x.size(), 0)};
    searched.rows = joined(by_piece(d.x.size(), 16384, [&](std::size_t i, std::size_t end) {
        std::vector<std::int32_t> rows;
        for (; i < end; ++i)
            if (displacement_square(d, i) > stays * stays) {
                rows.push_back(static_cast<std::int32_t>(i));
                searched.flags[i] = 1;
                d.searched_x[i] = d.x[i];
                d.searched_y[i] = d.y[i];
            }
        return rows;
    }));
    bool changed = find_disc_contacts(state, searched);
    if (surface_travel(state, base, state.clock.extension.m) > stays) {
        mark_surfaces(state);
        searched = all_discs(state);
    }
    changed |= find_base_contacts(state, base, searched);
    state.displacement_bound = greatest_displacement(state, base);
    return changed;
}

std::vector<bool> touching(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    std::vector<bool> result(c.first.size());
    constexpr std::size_t least = 4096; // whole words of bits
    in_pieces(result.size(), least, [&](std::size_t k, std::size_t end) {
        for (; k < end; ++k) {
            const auto i = static_cast<std::size_t>(c.first[k]),
                       j = static_cast<std::size_t>(c.second[k]);
            result[k] = c.bonded[k] ||
                        hypotenuse(d.x[j] - d.x[i], d.y[j] - d.y[i]) < d.radius[i] + d.radius[j];
        }
    });
    return result;
}

} // namespace listric::dem
