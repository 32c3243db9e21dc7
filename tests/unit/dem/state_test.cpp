// Rows move, physics does not: what belongs to a pair of discs follows their ids. The hash sees
// everything that the next cycle depends on. All comparisons are exact: values are only moved.

#include "tests/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace listric::state_test {

using namespace dem;
namespace {

using namespace support;

/// Pair of ids with all that its contact remembers; the shear force as the force on the pair's
/// lower id, which does not depend on which of the two comes first.
using Memory = std::tuple<std::int64_t, std::int64_t, double, double, int, float, float>;

std::vector<Memory> memories(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    std::vector<Memory> result;
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]);
        const auto j = static_cast<std::size_t>(c.second[k]);
        const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
        // On `second` along (-n_y, n_x).
        const double sign = d.id[j] < d.id[i] ? 1.0 : -1.0;
        const double scale = sign * c.shear_force[k] / std::hypot(dx, dy);
        result.emplace_back(std::min(d.id[i], d.id[j]), std::max(d.id[i], d.id[j]), -dy * scale,
                            dx * scale, c.bonded[k], c.tensile_strength[k], c.shear_strength[k]);
    }
    std::ranges::sort(result);
    return result;
}

/// A cloud with a different shear force and bond in every contact.
State cloud_with_history() {
    State state = make_state(cloud(12, 9, 90.0, 3));
    find_contacts(state, box(2500.0, 2500.0));
    const ContactColumns c = contact_columns(state);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        c.shear_force[k] = 1.0 + static_cast<double>(k);
        if (k % 3)
            bond(state, k, 100.0f + static_cast<float>(k), 500.0f + static_cast<float>(k));
    }
    const BaseContactColumns b = base_contact_columns(state);
    for (std::size_t k = 0; k < b.disc.size(); ++k)
        b.shear_force[k] = -1.0 - static_cast<double>(k);
    return state;
}

bool sorted_by_pair(const State& state) {
    const ConstContactColumns c = contact_columns(state);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        if (c.first[k] >= c.second[k])
            return false;
        if (k && std::pair(c.first[k - 1], c.second[k - 1]) >= std::pair(c.first[k], c.second[k]))
            return false;
    }
    return true;
}

TEST(State, AddDiscsGivesFreshIds) {
    State state = empty_state();
    EXPECT_EQ(add_discs(state, 2), 0u);
    reorder_discs(state, std::vector<std::int32_t>{1});
    EXPECT_EQ(add_discs(state, 2), 1u);
    EXPECT_THAT(disc_columns(state).id, testing::ElementsAre(1, 2, 3));
}

TEST(State, ReorderCarriesContactsByPair) {
    State state = cloud_with_history();
    const std::vector<Memory> before = memories(state);
    std::vector<std::int32_t> order(state.discs.rows());
    std::iota(order.rbegin(), order.rend(), 0);
    reorder_discs(state, order);
    EXPECT_EQ(disc_columns(state).id.front(), static_cast<std::int64_t>(order.size()) - 1);
    EXPECT_EQ(memories(state), before);
    EXPECT_TRUE(sorted_by_pair(state));
}

TEST(State, ReorderCarriesBaseContacts) {
    State state = cloud_with_history();
    const auto by_id = [](const State& s) {
        const ConstDiscColumns d = disc_columns(s);
        const ConstBaseContactColumns b = base_contact_columns(s);
        std::vector<std::tuple<std::int64_t, std::int32_t, double>> result;
        for (std::size_t k = 0; k < b.disc.size(); ++k)
            result.emplace_back(d.id[static_cast<std::size_t>(b.disc[k])], b.surface[k],
                                b.shear_force[k]);
        std::ranges::sort(result);
        return result;
    };
    const auto before = by_id(state);
    ASSERT_GT(before.size(), 12u);
    std::vector<std::int32_t> order(state.discs.rows());
    std::iota(order.rbegin(), order.rend(), 0);
    reorder_discs(state, order);
    EXPECT_EQ(by_id(state), before);
}

TEST(State, DroppedDiscsTakeTheirContactsAlong) {
    State state = cloud_with_history();
    std::vector<Memory> expected = memories(state);
    std::erase_if(expected, [](const Memory& m) {
        return std::get<0>(m) % 5 == 0 || std::get<1>(m) % 5 == 0;
    });
    std::vector<std::int32_t> order;
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(state.discs.rows()); ++k)
        if (k % 5)
            order.push_back(k);
    reorder_discs(state, order);
    EXPECT_EQ(memories(state), expected);
    for (std::int32_t disc : base_contact_columns(state).disc)
        EXPECT_LT(disc, static_cast<std::int32_t>(order.size()));
}

TEST(State, SortingLeavesTheSetOfContactsUnchanged) {
    State state = cloud_with_history();
    const std::vector<Memory> before = memories(state);
    sort_discs(state);
    EXPECT_EQ(memories(state), before);
    EXPECT_TRUE(sorted_by_pair(state));
    const DiscColumns d = disc_columns(state);
    EXPECT_FALSE(std::ranges::is_sorted(d.id)); // rows of the cloud became strips
    const double strip = 3.0 * state.mean_radius;
    for (std::size_t k = 1; k < d.x.size(); ++k)
        EXPECT_LE(std::floor(d.x[k - 1] / strip), std::floor(d.x[k] / strip));
}

TEST(State, HashSeesEveryColumn) {
    State state = cloud_with_history();
    state.discs.add<double>("memory_of_an_effect", "m", 0.0);
    const std::uint64_t before = hash(state);
    State copy = state;
    EXPECT_EQ(hash(copy), before);
    for (Table State::*table : {&State::discs, &State::contacts, &State::base_contacts})
        for (const Column& column : (state.*table).columns())
            for (std::size_t row : {std::size_t{0}, (state.*table).rows() - 1}) {
                Column changed = column;
                std::visit([&](auto& values) { values[row] += 1; }, changed.values);
                copy = state;
                (copy.*table).set(changed);
                EXPECT_NE(hash(copy), before) << column.name << " of row " << row;
            }
}

TEST(State, HashSeesEveryNumber) {
    const State state = cloud_with_history();
    const auto differs = [&](auto change) {
        State copy = state;
        change(copy);
        return hash(copy) != hash(state);
    };
    EXPECT_TRUE(differs([](State& s) { s.clock.cycle += 1; }));
    EXPECT_TRUE(differs([](State& s) { s.clock.time_step += 1e-9; }));
    EXPECT_TRUE(differs([](State& s) { s.clock.travel.m = s.clock.extension.m += 1e-9; }));
    EXPECT_TRUE(differs([](State& s) { s.ledger.initial += 1.0; }));
    EXPECT_TRUE(differs([](State& s) { s.ledger.deposited += 1.0; }));
    EXPECT_TRUE(differs([](State& s) { s.ledger.removed += 1.0; }));
    EXPECT_TRUE(differs([](State& s) { s.seed += 1; }));
    EXPECT_TRUE(differs([](State& s) { s.next_id += 1; }));
    EXPECT_TRUE(differs([](State& s) { s.mean_radius += 1e-9; }));
    EXPECT_TRUE(differs([](State& s) { s.inertial_mass_floor += 1.0; }));
    EXPECT_TRUE(differs([](State& s) { s.skin += 1e-9; }));
    EXPECT_TRUE(differs([](State& s) { s.displacement_bound += 1e-9; }));
    EXPECT_TRUE(differs([](State& s) { s.materials[weak].normal_stiffness += 1.0; }));
    EXPECT_TRUE(differs([](State& s) { s.materials[sediment].shear_stiffness += 1.0; }));
    EXPECT_TRUE(differs([](State& s) { s.materials[basement].friction += 0.1; }));
    EXPECT_TRUE(differs([](State& s) { s.materials[basement].bondable = false; }));
    EXPECT_TRUE(differs([](State& s) { s.materials.pop_back(); }));
}

} // namespace
} // namespace listric::state_test
