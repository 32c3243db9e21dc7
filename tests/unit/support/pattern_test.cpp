#include "apps/support/words/pattern.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace listric {
namespace pattern_test {

using testing::ElementsAre;
using testing::Optional;

TEST(Pattern, MatchesAWholeText) {
    EXPECT_TRUE(is_match("x12", "x[0-9]+"));
    EXPECT_FALSE(is_match("x12 ", "x[0-9]+"));
    EXPECT_FALSE(is_match("X12", "x[0-9]+"));
    EXPECT_TRUE(is_match_in_any_case("X12", "x[0-9]+"));
}

TEST(Pattern, GivesTheWholeAndItsParts) {
    EXPECT_THAT(parts_of("10 km", "([0-9]+) *([a-z]+)?"),
                Optional(ElementsAre("10 km", "10", "km")));
    EXPECT_THAT(parts_of("10", "([0-9]+) *([a-z]+)?"), Optional(ElementsAre("10", "10", "")));
    EXPECT_EQ(parts_of("km", "([0-9]+) *([a-z]+)?"), std::nullopt);
}

TEST(Pattern, FindsAllInTheirOrder) {
    const auto found = find_all("a1 b22", "[0-9]+");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].begin, 1u);
    EXPECT_EQ(found[1].begin, 4u);
    EXPECT_EQ(found[1].size, 2u);
    EXPECT_TRUE(find_all("", "[0-9]+").empty());
}

} // namespace pattern_test
} // namespace listric
