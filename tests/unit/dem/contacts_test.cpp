// The neighbour search lists exactly the pairs closer than the skin, and what a pair remembers
// survives it. Comparisons are exact: the brute force below decides with the same arithmetic.

#include "dem/cycle_physics.hpp"
#include "dem/threads/shared_loop.hpp"
#include "tests/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace listric::contacts_test {

using namespace dem;
namespace {

using namespace support;
using Pair = std::pair<std::int64_t, std::int64_t>;

State random_discs(std::size_t count, double side, std::uint64_t seed) {
    Random random(seed);
    std::vector<Disc> discs;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = random.between(0.0, side), y = random.between(0.0, side);
        discs.push_back({x, y, random.between(60.0, 120.0)});
    }
    return make_state(discs);
}

std::vector<Pair> brute_force(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        for (std::size_t j = i + 1; j < d.x.size(); ++j) {
            const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
            const double reach = d.radius[i] + d.radius[j] + state.skin;
            if (dx * dx + dy * dy < reach * reach)
                pairs.emplace_back(i, j);
        }
    return pairs;
}

std::vector<Pair> listed(const State& state) {
    const ConstContactColumns c = contact_columns(state);
    std::vector<Pair> pairs;
    for (std::size_t k = 0; k < c.first.size(); ++k)
        pairs.emplace_back(c.first[k], c.second[k]);
    return pairs;
}

void move_randomly(State& state, double distance, std::uint64_t seed) {
    Random random(seed);
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        d.x[i] += random.between(-distance, distance);
        d.y[i] += random.between(-distance, distance);
    }
}

TEST(Contacts, AreThoseOfBruteForceInOrder) {
    for (std::uint64_t seed : {1, 2, 3})
        for (double side : {1000.0, 5000.0, 50000.0}) {
            State state = random_discs(400, side, seed);
            find_contacts(state, {});
            EXPECT_EQ(listed(state), brute_force(state)) << "seed " << seed << ", side " << side;
        }
}

TEST(Contacts, OneDiscAndNoDisc) {
    State none = make_state({});
    find_contacts(none, {});
    EXPECT_EQ(none.contacts.rows(), 0u);
    State one = make_state({{5.0, 5.0, 1.0}});
    find_contacts(one, {});
    EXPECT_EQ(one.contacts.rows(), 0u);
}

TEST(Contacts, ADiscThatIsNowhereIsNamed) {
    for (const double nowhere :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        State state = make_state({{0.0, 0.0, 1.0}, {5.0, nowhere, 1.0}});
        try {
            find_contacts(state, {});
            FAIL();
        } catch (const NumericalFailure& failure) {
            EXPECT_THAT(failure.what(), testing::StartsWith("disc 1 ran away at x = 5.0"));
        }
    }
}

TEST(Contacts, SearchRemembersWhereDiscsWere) {
    State state = random_discs(50, 2000.0, 4);
    state.displacement_bound = 3.0;
    find_contacts(state, {});
    const DiscColumns d = disc_columns(state);
    EXPECT_THAT(d.searched_x, testing::ElementsAreArray(d.x));
    EXPECT_THAT(d.searched_y, testing::ElementsAreArray(d.y));
    EXPECT_EQ(state.displacement_bound, 0.0);
}

TEST(Contacts, HistorySurvivesRebuildsAfterMotion) {
    State state = random_discs(400, 3000.0, 5);
    state.contacts.add<std::int32_t>("memory_of_an_effect", "1", -7);
    find_contacts(state, {});
    std::map<Pair, double> history;
    for (std::uint64_t round = 0; round < 5; ++round) {
        const ContactColumns c = contact_columns(state);
        const auto memory = state.contacts.get<std::int32_t>("memory_of_an_effect");
        history.clear();
        for (std::size_t k = 0; k < c.first.size(); ++k) {
            c.shear_force[k] = 1e3 * static_cast<double>(round) + static_cast<double>(k) + 1.0;
            memory[k] = static_cast<std::int32_t>(c.shear_force[k]);
            history[{c.first[k], c.second[k]}] = c.shear_force[k];
        }
        move_randomly(state, 40.0, 10 + round);
        find_contacts(state, {});
        EXPECT_EQ(listed(state), brute_force(state));
        const ContactColumns now = contact_columns(state);
        const auto after = state.contacts.get<std::int32_t>("memory_of_an_effect");
        std::size_t old_pairs = 0;
        for (std::size_t k = 0; k < now.first.size(); ++k) {
            const auto known = history.find({now.first[k], now.second[k]});
            const bool is_old = known != history.end();
            old_pairs += is_old;
            EXPECT_EQ(now.shear_force[k], is_old ? known->second : 0.0);
            EXPECT_EQ(after[k], is_old ? static_cast<std::int32_t>(known->second) : -7);
        }
        // Both kinds must occur, or the test shows nothing.
        EXPECT_GT(old_pairs, now.first.size() / 2);
        EXPECT_LT(old_pairs, now.first.size());
    }
}

TEST(Contacts, PairsThatPartForget) {
    State state = make_state(row(2, 100.0));
    find_contacts(state, {});
    contact_columns(state).shear_force[0] = 5.0;
    disc_columns(state).x[1] += 1000.0;
    find_contacts(state, {});
    ASSERT_EQ(state.contacts.rows(), 0u);
    disc_columns(state).x[1] -= 1000.0;
    find_contacts(state, {});
    ASSERT_EQ(state.contacts.rows(), 1u);
    EXPECT_EQ(contact_columns(state).shear_force[0], 0.0);
}

TEST(Contacts, BondedPairsAreKeptBeyondTheSkin) {
    State state = random_discs(300, 3000.0, 6);
    find_contacts(state, {});
    std::map<Pair, float> bonds;
    for (std::size_t k = 0; k < state.contacts.rows(); k += 4) {
        const float strength = 1.0f + static_cast<float>(k);
        bond(state, k, strength, 2.0f * strength);
        bonds[listed(state)[k]] = strength;
    }
    move_randomly(state, 2000.0, 7);
    std::set<Pair> expected;
    for (const Pair& pair : brute_force(state))
        expected.insert(pair);
    const std::size_t near = expected.size();
    for (const auto& [pair, strength] : bonds)
        expected.insert(pair);
    ASSERT_GT(expected.size(), near + bonds.size() / 2);
    for (int round = 0; round < 2; ++round) {
        find_contacts(state, {});
        EXPECT_EQ(listed(state), std::vector<Pair>(expected.begin(), expected.end()));
        const ContactColumns c = contact_columns(state);
        for (std::size_t k = 0; k < c.first.size(); ++k) {
            const auto known = bonds.find({c.first[k], c.second[k]});
            ASSERT_EQ(c.bonded[k] == 1, known != bonds.end());
            if (c.bonded[k]) {
                EXPECT_EQ(c.tensile_strength[k], known->second);
                EXPECT_EQ(c.shear_strength[k], 2.0f * known->second);
            }
        }
    }
}

TEST(Contacts, BaseContactsWithHistory) {
    // Radius 100, skin 25: in the corner of the box a disc meets two surfaces, in the middle one.
    const RigidBase base = box(2000.0, 5000.0);
    State state = make_state({{110.0, 120.0, 100.0},
                              {1000.0, 124.0, 100.0},
                              {1000.0, 400.0, 100.0},
                              {1950.0, 2000.0, 100.0}});
    find_contacts(state, base);
    const BaseContactColumns b = base_contact_columns(state);
    EXPECT_THAT(b.disc, testing::ElementsAre(0, 0, 1, 3));
    EXPECT_THAT(b.surface, testing::ElementsAre(0, 1, 1, 2));
    for (std::size_t k = 0; k < 4; ++k)
        b.shear_force[k] = 1.0 + static_cast<double>(k);
    const DiscColumns d = disc_columns(state);
    d.x[0] = 500.0; // leaves the left wall
    d.y[2] = 110.0; // reaches the floor
    find_contacts(state, base);
    const BaseContactColumns now = base_contact_columns(state);
    EXPECT_THAT(now.disc, testing::ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(now.surface, testing::ElementsAre(1, 1, 1, 2));
    EXPECT_THAT(now.shear_force, testing::ElementsAre(2.0, 3.0, 0.0, 4.0));
}

TEST(Contacts, DiscsBesideAnOpenEndAreListed) {
    // They may come back over the surface before lists are updated. Radius 100, skin 25.
    RigidBase base;
    base.surfaces = {{"floor", {line({0.0, 0.0}, {1000.0, 0.0})}, 0.0}};
    State state = make_state(
        {{-5.0, 95.0, 100.0}, {1005.0, 95.0, 100.0}, {-100.0, 95.0, 100.0}, {-5.0, 300.0, 100.0}});
    find_contacts(state, base);
    EXPECT_THAT(base_contact_columns(state).disc, testing::ElementsAre(0, 1));
    base.surfaces[0].translation = {1.0, 0.0}; // ends move along
    state.clock.travel.m = state.clock.extension.m = 1000.0;
    find_contacts(state, base);
    EXPECT_THAT(base_contact_columns(state).disc, testing::ElementsAre(1));
}

TEST(Contacts, TranslatingSurfacesAreFoundWhereTheyAre) {
    RigidBase base = box(2000.0, 5000.0);
    base.surfaces[2].translation = {1.0, 0.0};
    State state = make_state({{1950.0, 2000.0, 100.0}, {2950.0, 2000.0, 100.0}});
    state.clock.travel.m = state.clock.extension.m = 1000.0;
    find_contacts(state, base);
    EXPECT_THAT(base_contact_columns(state).disc, testing::ElementsAre(1));
}

TEST(Contacts, ThreadsListTheSame) {
    // Loops over thousands of discs are cut.
    const RigidBase base = box(15000.0, 20000.0);
    std::vector<State> states;
    states.reserve(4);
    for (int threads : {1, 2, 3, 5}) {
        const Team team(threads);
        State& state = states.emplace_back(random_discs(20000, 15000.0, 8));
        sort_discs(state);
        find_contacts(state, base);
        const std::size_t before = state.contacts.rows();
        for (std::size_t k = 0; k < before; ++k)
            contact_columns(state).shear_force[k] = static_cast<double>(k);
        move_randomly(state, 9.0, 9); // some by more than a fifth of the skin, some by less
        const State moved = state;
        EXPECT_TRUE(update_contacts(state, base));
        EXPECT_NE(state.contacts.rows(), before);
        EXPECT_NE(hash(state), hash(moved));
        const std::vector<bool> touches = touching(state);
        for (std::size_t k = 0; k < touches.size(); ++k)
            contact_columns(state).bonded[k] = touches[k];
        EXPECT_EQ(hash(state), hash(states.front())) << threads << " threads";
        EXPECT_EQ(greatest_displacement(state, base), greatest_displacement(states.front(), base));
    }
}

TEST(Contacts, TouchingMeansOverlapOrBond) {
    State state = make_state(
        {{0.0, 0.0, 100.0}, {199.0, 0.0, 100.0}, {410.0, 0.0, 100.0}, {620.0, 0.0, 100.0}});
    find_contacts(state, {});
    ASSERT_EQ(state.contacts.rows(), 3u);
    bond(state, 2, 1.0f, 1.0f);
    EXPECT_EQ(touching(state), (std::vector<bool>{true, false, true}));
}

} // namespace
} // namespace listric::contacts_test
