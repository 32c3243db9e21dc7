// Sums that do not depend on their order are equal to the bit, and exact to their grid of 2^-34;
// maxima keep what is no number.

#include "dem/numbers/order_free.hpp"
#include "dem/numbers/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace listric::order_free_test {

using namespace dem;
namespace {

double sum(const std::vector<double>& numbers) {
    OrderFreeSum s;
    for (const double number : numbers)
        s += number;
    return s.value();
}

TEST(OrderFree, SumsAreEqualInEveryOrder) {
    std::vector<double> numbers;
    for (std::uint64_t k = 0; k < 1000; ++k) // of 30 orders of magnitude
        numbers.push_back((uniform(7, Purpose::packing_place, 0, k) - 0.5) *
                          std::pow(10.0, static_cast<double>(k % 30) - 12.0));
    const double forward = sum(numbers);
    std::ranges::reverse(numbers);
    EXPECT_EQ(sum(numbers), forward);
    std::ranges::sort(numbers);
    EXPECT_EQ(sum(numbers), forward);
    EXPECT_NEAR(forward, std::accumulate(numbers.begin(), numbers.end(), 0.0L), 1e-15 * 1e20);
}

TEST(OrderFree, SumsAreExactToTheGrid) {
    EXPECT_EQ(sum({}), 0.0);
    EXPECT_EQ(sum({1.5, -2.25, 1e15, 0x1p-34}), 1e15 - 0.75); // rounded once, at the end
    EXPECT_EQ(sum({0x1p-34, 0x1p-34}), 0x1p-33);
    EXPECT_EQ(sum({1e18, 1.0, -1e18}), 1.0);
    EXPECT_EQ(sum({-3.75}), -3.75);
}

TEST(OrderFree, TheGreaterOfTwoIsNaNIfOneIs) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(greater(1.0, 2.0), 2.0);
    EXPECT_EQ(greater(2.0, 1.0), 2.0);
    EXPECT_EQ(greater(0.0, std::numeric_limits<double>::infinity()),
              std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(greater(nan, 1.0)));
    EXPECT_TRUE(std::isnan(greater(1.0, nan)));
}

} // namespace
} // namespace listric::order_free_test
