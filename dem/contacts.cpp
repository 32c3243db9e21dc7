#include "dem/contacts.hpp"

#include "dem/cells.hpp"

#include <algorithm>
#include <cmath>

namespace listric {

namespace {

/// Contact rows by first disc: those of disc i are begin[i] .. begin[i + 1] - 1.
std::vector<std::int32_t> rows_by_disc(std::span<const std::int32_t> disc, std::size_t discs) {
    std::vector<std::int32_t> begin(discs + 1, 0);
    for (std::int32_t i : disc)
        ++begin[static_cast<std::size_t>(i) + 1];
    for (std::size_t i = 0; i < discs; ++i)
        begin[i + 1] += begin[i];
    return begin;
}

/// Replaces the table's rows by `count` rows; new row k inherits all columns of old row
/// inherited[k], or starts afresh where that is -1.
void replace_rows(Table& table, std::vector<std::int32_t>& inherited) {
    const auto old_rows = static_cast<std::int32_t>(table.rows());
    table.resize(table.rows() + 1); // one more row, of initial values
    for (std::int32_t& row : inherited)
        if (row < 0)
            row = old_rows;
    table.reorder(inherited);
}

void find_disc_contacts(State& state) {
    const DiscColumns d = disc_columns(state);
    const std::size_t n = d.x.size();
    const double largest = n ? *std::ranges::max_element(d.radius) : 0.0;
    const Cells cells(d.x, d.y, 2.0 * largest + state.skin);

    const ContactColumns old = contact_columns(state);
    const std::vector<std::int32_t> begin = rows_by_disc(old.first, n);

    std::vector<std::int32_t> first, second, inherited;
    first.reserve(3 * n);
    second.reserve(3 * n);
    inherited.reserve(3 * n);
    std::vector<std::pair<std::int32_t, std::int32_t>> found; // second disc, old row
    for (std::size_t i = 0; i < n; ++i) {
        found.clear();
        cells.for_each_near(d.x[i], d.y[i], [&](std::int32_t candidate) {
            const auto j = static_cast<std::size_t>(candidate);
            if (j <= i)
                return;
            const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
            const double reach = d.radius[i] + d.radius[j] + state.skin;
            if (dx * dx + dy * dy < reach * reach)
                found.emplace_back(candidate, -1);
        });
        for (std::int32_t row = begin[i]; row < begin[i + 1]; ++row) {
            const auto r = static_cast<std::size_t>(row);
            const auto pair = std::ranges::find(found, old.second[r],
                                                &std::pair<std::int32_t, std::int32_t>::first);
            if (pair != found.end())
                pair->second = row;
            else if (old.bonded[r])
                found.emplace_back(old.second[r], row);
        }
        std::ranges::sort(found);
        for (const auto& [j, row] : found) {
            first.push_back(static_cast<std::int32_t>(i));
            second.push_back(j);
            inherited.push_back(row);
        }
    }
    replace_rows(state.contacts, inherited);
    const ContactColumns contacts = contact_columns(state);
    std::ranges::copy(first, contacts.first.begin());
    std::ranges::copy(second, contacts.second.begin());
}

void find_base_contacts(State& state, const RigidBase& base) {
    const DiscColumns d = disc_columns(state);
    const BaseContactColumns old = base_contact_columns(state);
    const std::vector<std::int32_t> begin = rows_by_disc(old.disc, d.x.size());

    std::vector<std::int32_t> disc, surface, inherited;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        for (std::size_t s = 0; s < base.surfaces.size(); ++s) {
            const Surface& face = base.surfaces[s];
            const auto foot =
                nearest(face.chain, {d.x[i] - face.translation * state.clock.extension, d.y[i]});
            if (!foot || foot->distance > d.radius[i] + state.skin)
                continue;
            std::int32_t row = begin[i];
            while (row < begin[i + 1] &&
                   old.surface[static_cast<std::size_t>(row)] != static_cast<std::int32_t>(s))
                ++row;
            disc.push_back(static_cast<std::int32_t>(i));
            surface.push_back(static_cast<std::int32_t>(s));
            inherited.push_back(row < begin[i + 1] ? row : -1);
        }
    replace_rows(state.base_contacts, inherited);
    const BaseContactColumns contacts = base_contact_columns(state);
    std::ranges::copy(disc, contacts.disc.begin());
    std::ranges::copy(surface, contacts.surface.begin());
}

} // namespace

void find_contacts(State& state, const RigidBase& base) {
    find_disc_contacts(state);
    find_base_contacts(state, base);
    const DiscColumns d = disc_columns(state);
    std::ranges::copy(d.x, d.searched_x.begin());
    std::ranges::copy(d.y, d.searched_y.begin());
    state.displacement_bound = 0.0;
}

std::vector<bool> touching(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    std::vector<bool> result(c.first.size());
    for (std::size_t k = 0; k < result.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]),
                   j = static_cast<std::size_t>(c.second[k]);
        result[k] =
            c.bonded[k] || std::hypot(d.x[j] - d.x[i], d.y[j] - d.y[i]) < d.radius[i] + d.radius[j];
    }
    return result;
}

} // namespace listric
