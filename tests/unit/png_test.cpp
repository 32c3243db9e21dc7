#include "apps/support/png.hpp"

#include "apps/support/error.hpp"

#include <gmock/gmock.h>
#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace listric::png_test {
namespace {

using testing::HasSubstr;

std::string number(std::uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
            static_cast<char>(value >> 8), static_cast<char>(value)};
}

std::string chunk(const std::string& name, const std::string& data) {
    const std::string body = name + data;
    const auto sum = crc32(0, reinterpret_cast<const unsigned char*>(body.data()),
                           static_cast<unsigned>(body.size()));
    return number(static_cast<std::uint32_t>(data.size())) + body +
           number(static_cast<std::uint32_t>(sum));
}

std::string packed(const std::string& bytes) {
    std::string out(compressBound(bytes.size()), '\0');
    auto size = static_cast<uLongf>(out.size());
    compress(reinterpret_cast<unsigned char*>(out.data()), &size,
             reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    out.resize(size);
    return out;
}

const std::string signature = "\x89PNG\r\n\x1a\n";

/// A grey picture that says it has such a size, with that many bytes of pixels.
std::string png(std::uint32_t width, std::uint32_t height, std::size_t bytes, char depth = 8,
                char colour = 0) {
    const std::string header =
        number(width) + number(height) + depth + colour + std::string(3, '\0');
    return signature + chunk("IHDR", header) + chunk("IDAT", packed(std::string(bytes, '\x40'))) +
           chunk("IEND", "");
}

class PngFile : public testing::Test {
protected:
    std::filesystem::path file = std::filesystem::path(testing::TempDir()) /
                                 ("listric-png-" + std::to_string(getpid()) + ".png");
    ~PngFile() override { std::filesystem::remove(file); }

    /// Why it is refused; empty if it is not.
    std::string refusal(const std::string& bytes) {
        std::ofstream(file, std::ios::binary) << bytes;
        try {
            const Png picture = read_png(file);
            EXPECT_EQ(picture.bytes, bytes);
        } catch (const UsageError& error) {
            EXPECT_THAT(error.what(), HasSubstr(file.string()));
            return error.what();
        }
        return "";
    }
};

TEST_F(PngFile, IsReadWhateverItsColours) {
    EXPECT_EQ(refusal(png(3, 2, 8)), "");
    EXPECT_EQ(refusal(png(9, 2, 6, 1)), "");
    EXPECT_EQ(refusal(png(3, 2, 14, 16)), "");
    EXPECT_EQ(refusal(png(3, 2, 20, 8, 2)), "");
    EXPECT_EQ(refusal(png(3, 2, 14, 8, 4)), "");
    EXPECT_EQ(refusal(png(3, 2, 50, 16, 6)), "");
}

TEST_F(PngFile, IsRefusedWhereItIsSomethingElse) {
    EXPECT_THAT(refusal(""), HasSubstr("is empty"));
    EXPECT_THAT(refusal("\xff\xd8\xff\xe0 JFIF"),
                HasSubstr("is a JPEG, and a picture must be a PNG"));
    EXPECT_THAT(refusal(std::string("II*\0....", 8)), HasSubstr("is a TIFF"));
    EXPECT_THAT(refusal("hello"), HasSubstr("is something else"));
}

TEST_F(PngFile, IsRefusedWhereItIsCutOffOrDamaged) {
    const std::string whole = png(3, 2, 8);
    for (std::size_t length = 1; length < whole.size(); ++length)
        EXPECT_NE(refusal(whole.substr(0, length)), "") << length;
    for (std::size_t k = 0; k < whole.size(); ++k) {
        std::string damaged = whole;
        damaged[k] = static_cast<char>(damaged[k] ^ 0x11);
        EXPECT_NE(refusal(damaged), "") << k;
    }
    EXPECT_THAT(refusal(whole.substr(0, whole.size() - 12)), HasSubstr("its end is missing"));
    EXPECT_THAT(refusal(png(3, 2, 7)), HasSubstr("pixels are missing"));
    EXPECT_THAT(refusal(png(0, 2, 8)), HasSubstr("its size or its colours"));
    EXPECT_THAT(refusal(png(3, 2, 8, 3)), HasSubstr("its size or its colours"));
}

TEST_F(PngFile, IsRefusedWhereItIsTooLarge) {
    EXPECT_THAT(refusal(png(50000, 50000, 8)), HasSubstr("has 50000 x 50000 pixels"));
    EXPECT_THAT(refusal(png(0x7fffffff, 0x7fffffff, 8)), HasSubstr("100 million"));
    // Zeros without end behind a small size are counted, not kept.
    EXPECT_EQ(refusal(png(3, 2, 40'000'000)), "");
}

} // namespace
} // namespace listric::png_test
