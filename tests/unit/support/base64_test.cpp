#include "apps/support/files/base64.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace listric::base64_test {
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

} // namespace
} // namespace listric::base64_test
