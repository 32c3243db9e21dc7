// Classes of rock behaviour [paper, Fig. 5] from bonds, age and weakening.

#include "apps/measures/faults/rock_behaviour.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace listric::measures::rock_behaviour_test {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

RockBehaviour of(double unbonded_share, std::int32_t stratum, std::uint8_t material) {
    const std::vector<dem::Material> materials(3);
    return rock_behaviour(std::array{unbonded_share}, std::array{stratum}, std::array{material},
                          materials)
        .front();
}

TEST(RockBehaviour, IntactRockIsElasticUpToAQuarterOfItsContacts) {
    EXPECT_EQ(of(0.0, 0, dem::basement), RockBehaviour::elastic);
    EXPECT_EQ(of(0.25, 0, dem::basement), RockBehaviour::elastic);
    EXPECT_EQ(of(0.25, 3, dem::sediment), RockBehaviour::elastic);
}

TEST(RockBehaviour, CrackedRockIsPlastic) {
    EXPECT_EQ(of(0.26, 0, dem::basement), RockBehaviour::plastic);
    EXPECT_EQ(of(1.0, 0, dem::basement), RockBehaviour::plastic);
    EXPECT_EQ(of(0.5, 3, dem::sediment), RockBehaviour::plastic);
}

TEST(RockBehaviour, SedimentMainlyWithoutBondsIsUnconsolidated) {
    EXPECT_EQ(of(0.51, 1, dem::sediment), RockBehaviour::unconsolidated);
    EXPECT_EQ(of(1.0, 7, dem::sediment), RockBehaviour::unconsolidated);
}

TEST(RockBehaviour, WeakenedRockIsSoWhateverItsBondsAndAge) {
    for (const double share : {0.0, 0.4, 1.0})
        for (const int stratum : {0, 5})
            EXPECT_EQ(of(share, stratum, dem::weak), RockBehaviour::weakened);
}

// Discs in a row: 0 and 1 touch and are bonded, 1 and 2 touch, 2 and 3 are in the list but apart.
TEST(RockBehaviour, SharesOfContactsWithoutBond) {
    dem::State state = dem::empty_state();
    state.mean_radius = 1.0;
    state.discs.resize(4);
    const dem::DiscColumns d = dem::disc_columns(state);
    for (std::size_t i = 0; i < 4; ++i) {
        d.x[i] = std::array{0.0, 1.9, 3.8, 6.5}[i];
        d.radius[i] = 1.0;
    }
    state.contacts.resize(3);
    const dem::ContactColumns c = dem::contact_columns(state);
    for (std::int32_t k = 0; k < 3; ++k) {
        c.first[static_cast<std::size_t>(k)] = k;
        c.second[static_cast<std::size_t>(k)] = k + 1;
    }
    c.bonded[0] = 1;
    EXPECT_THAT(unbonded_shares(state),
                ElementsAre(DoubleEq(0.0), DoubleEq(0.5), DoubleEq(1.0), DoubleEq(1.0)));
}

} // namespace
} // namespace listric::measures::rock_behaviour_test
