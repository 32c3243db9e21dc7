#include "apps/support/files/encoding.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace listric::encoding_test {
namespace {

std::string encoded(const std::string& text) {
    return base64(std::vector<unsigned char>(text.begin(), text.end()));
}

TEST(Base64Test, VectorsOfRfc4648) {
    const std::pair<std::string, std::string> vectors[] = {
        {"", ""},
        {"f", "Zg=="},
        {"fo", "Zm8="},
        {"foo", "Zm9v"},
        {"foob", "Zm9vYg=="},
        {"fooba", "Zm9vYmE="},
        {"foobar", "Zm9vYmFy"},
    };
    for (const auto& [text, expected] : vectors)
        EXPECT_EQ(encoded(text), expected) << text;
}

TEST(Base64Test, EveryLetterAndBytesAboveText) {
    std::string bytes; // six-bit numbers 0 to 63 in turn
    for (unsigned k = 0; k < 64; k += 4) {
        const unsigned group = k << 18 | (k + 1) << 12 | (k + 2) << 6 | (k + 3);
        for (const unsigned shift : {16u, 8u, 0u})
            bytes += static_cast<char>(group >> shift & 255u);
    }
    EXPECT_EQ(encoded(bytes), "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/");
    EXPECT_EQ(encoded("\xff\xff"), "//8=");
}

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
} // namespace listric::encoding_test
