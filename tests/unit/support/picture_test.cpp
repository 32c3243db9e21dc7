#include "apps/support/files/picture.hpp"

#include "apps/support/error.hpp"

#include <gmock/gmock.h>
#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace listric::picture_test {
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

/// A part of a JPEG: mark, length, content.
std::string segment(char mark, const std::string& data) {
    const auto size = static_cast<std::uint32_t>(data.size() + 2);
    return "\xff" + std::string(1, mark) + number(size).substr(2) + data;
}

/// A JPEG of 3 x 2 pixels as it lies in a file; its pixels could not be shown.
std::string jpeg(char frame = '\xc0', char bits = 8,
                 const std::string& size = number(2 << 16 | 3)) {
    return "\xff\xd8" + segment('\xe0', "JFIF") + segment('\xc4', "table") + "\xff" +
           segment(frame, bits + size + '\3') + segment('\xda', "head") +
           std::string("pix\xff\0els\xff\xd0more", 13) + segment('\xda', "second") +
           "pixels\xff\xd9";
}

class PictureFile : public testing::Test {
protected:
    std::filesystem::path file = std::filesystem::path(testing::TempDir()) /
                                 ("listric-picture-" + std::to_string(getpid()) + ".dat");
    ~PictureFile() override { std::filesystem::remove(file); }

    int wanted_width = 3, wanted_height = 2; ///< of a picture that is not refused

    /// Why it is refused; empty if it is not.
    std::string refusal(const std::string& bytes) {
        std::ofstream(file, std::ios::binary) << bytes;
        try {
            const Picture picture = read_picture(file);
            EXPECT_EQ(picture.bytes, bytes);
            EXPECT_EQ(picture.type, bytes.starts_with(signature) ? "png" : "jpeg");
            EXPECT_EQ(picture.width, wanted_width);
            EXPECT_EQ(picture.height, wanted_height);
        } catch (const UsageError& error) {
            EXPECT_THAT(error.what(), HasSubstr(file.string()));
            return error.what();
        }
        return "";
    }
};

TEST_F(PictureFile, PngIsReadWhateverItsColours) {
    EXPECT_EQ(refusal(png(3, 2, 8)), "");
    EXPECT_EQ(refusal(png(3, 2, 14, 16)), "");
    EXPECT_EQ(refusal(png(3, 2, 20, 8, 2)), "");
    EXPECT_EQ(refusal(png(3, 2, 14, 8, 4)), "");
    EXPECT_EQ(refusal(png(3, 2, 50, 16, 6)), "");
    wanted_width = 9;
    EXPECT_EQ(refusal(png(9, 2, 6, 1)), "");
}

TEST_F(PictureFile, SomethingElseIsRefused) {
    EXPECT_THAT(refusal(""), HasSubstr("is empty"));
    EXPECT_THAT(refusal(std::string("II*\0....", 8)),
                HasSubstr("is a TIFF, and a picture must be a PNG or JPEG"));
    EXPECT_THAT(refusal(std::string("\1\2\3", 3)), HasSubstr("is something else"));
    EXPECT_EQ(refusal("x_m,depth_m\n1,2\n").find("PIL"), std::string::npos); // no picture at all
    EXPECT_THAT(refusal("x_m,depth_m\n1,2\n"), HasSubstr("is a text"));
    EXPECT_THAT(refusal("<?xml version=\"1.0\"?>\n<svg width=\"10\"/>"),
                HasSubstr("export it as PNG"));
}

TEST_F(PictureFile, PngIsRefusedWhereItIsCutOff) {
    const std::string whole = png(3, 2, 8);
    for (std::size_t length = 1; length + 8 < whole.size(); ++length)
        EXPECT_NE(refusal(whole.substr(0, length)), "") << length;
    EXPECT_THAT(refusal(whole.substr(0, whole.size() - 12)), HasSubstr("its end is missing"));
    EXPECT_THAT(refusal(png(0, 2, 8)), HasSubstr("its width or height is 0"));
}

TEST_F(PictureFile, PngIsRefusedWhereItIsTooLarge) {
    EXPECT_THAT(refusal(png(50000, 50000, 8)), HasSubstr("has 50000 x 50000 pixels"));
    EXPECT_THAT(refusal(png(0x7fffffff, 0x7fffffff, 8)), HasSubstr("100 million"));
}

TEST_F(PictureFile, JpegIsRead) {
    EXPECT_EQ(refusal(jpeg()), "");
    EXPECT_EQ(refusal(jpeg('\xc2')), "") << "progressive";
    EXPECT_EQ(refusal(jpeg() + "what a telephone writes behind the end"), "");
}

TEST_F(PictureFile, JpegIsRefusedWhereItIsCutOff) {
    const std::string whole = jpeg();
    for (std::size_t length = 3; length < whole.size(); ++length)
        EXPECT_THAT(refusal(whole.substr(0, length)), HasSubstr("is a JPEG that is damaged or cut"))
            << length;
    EXPECT_THAT(refusal("\xff\xd8\xff\xd9"), HasSubstr("its size is missing"));
    EXPECT_THAT(refusal(jpeg('\xc0', 8, number(3))), HasSubstr("its width or height is 0"));
    EXPECT_THAT(refusal(jpeg('\xc0', 8, number(0xffffffff))), HasSubstr("65535 x 65535 pixels"));
}

TEST_F(PictureFile, JpegThatBrowsersDoNotShowIsRefused) {
    EXPECT_THAT(refusal(jpeg('\xc9')), HasSubstr("browsers do not show"));
    EXPECT_THAT(refusal(jpeg('\xc0', 12)), HasSubstr("browsers do not show"));
}

} // namespace
} // namespace listric::picture_test
