#include "apps/support/files/deflate.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <stdexcept>
#include <vector>

namespace listric::deflate_test {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes inflated(const Bytes& bytes, std::size_t expected) {
    Bytes result(expected);
    uLongf size = expected;
    EXPECT_EQ(uncompress(result.data(), &size, bytes.data(), bytes.size()), Z_OK);
    EXPECT_EQ(size, expected);
    return result;
}

TEST(DeflateTest, ComesBackAtEveryLevel) {
    Bytes bytes;
    for (unsigned k = 0; k < 100000; ++k)
        bytes.push_back(static_cast<unsigned char>(k * k >> 8));
    for (int level = 0; level <= 9; ++level)
        EXPECT_EQ(inflated(deflated(bytes, level), bytes.size()), bytes) << level;
    EXPECT_LT(deflated(bytes, 6).size(), deflated(bytes, 0).size());
}

TEST(DeflateTest, NothingIsAStreamToo) {
    uLongf size = 0;
    unsigned char none = 0;
    const Bytes bytes = deflated({}, 6);
    EXPECT_EQ(uncompress(&none, &size, bytes.data(), bytes.size()), Z_OK);
    EXPECT_EQ(size, 0);
}

TEST(DeflateTest, RefusesAnotherLevel) {
    EXPECT_THROW(deflated({}, -1), std::invalid_argument);
    EXPECT_THROW(deflated({}, 10), std::invalid_argument);
}

} // namespace
} // namespace listric::deflate_test
