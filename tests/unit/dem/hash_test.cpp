// Hashes stand in files and in recorded results: their values may not change.

#include "dem/numbers/hash.hpp"

#include <gtest/gtest.h>

#include <array>

namespace listric::dem::hash_test {
namespace {

TEST(Hash, ValuesStay) {
    EXPECT_EQ(mixed(0x4c697374726963u, 1), 0x655ca3a10bd0f1e5u);
    EXPECT_EQ(chained(0x4c697374726963u, 1), 0xc520c7b08276dcc6u);
    EXPECT_EQ(fnv1a("listric"), 0xd7fa00d613e924cfu);
    EXPECT_EQ(fnv1a(std::array{1.0, -0.5}), 0xef391300c548b8fbu);
}

TEST(Hash, TextInPartsIsTheTextInOne) {
    EXPECT_EQ(fnv1a("ric", fnv1a("list")), fnv1a("listric"));
    EXPECT_EQ(fnv1a(""), fnv1a_start);
}

TEST(Hash, OrderMatters) {
    EXPECT_NE(chained(chained(0, 1), 2), chained(chained(0, 2), 1));
    EXPECT_NE(mixed(mixed(0, 1), 2), mixed(mixed(0, 2), 1));
}

} // namespace
} // namespace listric::dem::hash_test
