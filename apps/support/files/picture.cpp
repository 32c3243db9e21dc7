#include "apps/support/files/picture.hpp"

#include "apps/support/error.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

namespace listric {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view signature = "\x89PNG\r\n\x1a\n"sv;
constexpr std::string_view jpeg_signature = "\xff\xd8\xff"sv;
constexpr std::uintmax_t most_bytes = 1'000'000'000;

/// How other pictures begin.
constexpr std::pair<std::string_view, std::string_view> others[] = {
    {"II*\0"sv, "a TIFF"},
    {"MM\0*"sv, "a TIFF"},
    {"II+\0"sv, "a BigTIFF"},
    {"GIF8"sv, "a GIF"},
    {"BM"sv, "a BMP"},
    {"%PDF"sv, "a PDF"},
    {"<svg"sv, "an SVG"},
    {"<?xml"sv, "XML, perhaps an SVG"},
    {"RIFF"sv, "perhaps a WebP"},
    {"%!PS"sv, "PostScript"},
    {"SEG"sv, "perhaps a SEG-Y"},
    {"\0\0\0\x0cjP  "sv, "a JPEG 2000"},
};

std::uint32_t number_at(std::string_view bytes, std::size_t place) {
    std::uint32_t number = 0;
    for (std::size_t k = 0; k < 4; ++k)
        number = number << 8 | static_cast<unsigned char>(bytes[place + k]);
    return number;
}

/// Throws UsageError without the file's name.
[[noreturn]] void refuse(const std::string& why) { throw UsageError(why); }

[[noreturn]] void refuse_damaged(const char* kind, const std::string& how) {
    refuse(
        fmt::format("is a {} that is damaged or cut off ({}); fetch or save it again", kind, how));
}

/// Refuses pictures that no program could show.
void require_size(double width, double height) {
    if (width * height > most_pixels)
        refuse(fmt::format("has {:.0f} x {:.0f} pixels, and a picture may have {:.0f} million of "
                           "them; make it smaller",
                           width, height, 1e-6 * most_pixels));
}

void read_png(Picture& png) {
    const std::string_view bytes = png.bytes;
    if (bytes.size() < 24 || bytes.substr(12, 4) != "IHDR")
        refuse_damaged("PNG", "it does not begin with its size");
    const double width = number_at(bytes, 16), height = number_at(bytes, 20);
    if (width < 1.0 || height < 1.0)
        refuse_damaged("PNG", "its width or height is 0");
    require_size(width, height);
    if (bytes.rfind("IEND") == bytes.npos)
        refuse_damaged("PNG", "its end is missing");
    png.type = "png";
    png.width = static_cast<int>(width);
    png.height = static_cast<int>(height);
}

/// Walks the segments up to the frame, which has the size.
void read_jpeg(Picture& jpeg) {
    const std::string_view bytes = jpeg.bytes;
    const auto byte_at = [&](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
    const auto pair_at = [&](std::size_t at) { return byte_at(at) << 8 | byte_at(at + 1); };
    for (std::size_t at = 2; at + 9 < bytes.size() && byte_at(at) == 0xff;) {
        const unsigned mark = byte_at(at + 1);
        // Marks c0 to cf begin a frame, but for tables (c4, cc) and a reserved one (c8).
        if (mark < 0xc0 || mark > 0xcf || mark == 0xc4 || mark == 0xc8 || mark == 0xcc) {
            at += mark == 0xff ? 1 : 2 + static_cast<std::size_t>(pair_at(at + 2));
            continue;
        }
        if (mark > 0xc2 || byte_at(at + 4) != 8)
            refuse("is a JPEG of a kind that browsers do not show (lossless, arithmetic or with "
                   "more than 8 bits); save it again as an ordinary JPEG or a PNG");
        jpeg.height = pair_at(at + 5);
        jpeg.width = pair_at(at + 7);
        if (jpeg.width == 0 || jpeg.height == 0)
            refuse_damaged("JPEG", "its width or height is 0");
        require_size(jpeg.width, jpeg.height);
        if (bytes.rfind("\xff\xd9") == bytes.npos)
            refuse_damaged("JPEG", "its end is missing");
        jpeg.type = "jpeg";
        return;
    }
    refuse_damaged("JPEG", "its size is missing");
}

/// Whether a file's beginning has nothing but letters and ends of lines.
bool is_text(std::string_view head) {
    return std::ranges::none_of(head, [](unsigned char letter) {
        return letter < ' ' && letter != '\n' && letter != '\r' && letter != '\t';
    });
}

[[noreturn]] void refuse_other(const std::string& bytes) {
    std::string_view what = "something else";
    for (const auto& [begin, name] : others)
        if (bytes.starts_with(begin))
            what = name;
    const std::string_view head = std::string_view(bytes).substr(0, 2000);
    if (head.find("<svg") != head.npos)
        refuse("is an SVG, and a picture must be a PNG or JPEG; export it as PNG from the program "
               "that drew it");
    if (what == "something else" && is_text(head))
        refuse("is a text, and a picture must be a PNG or JPEG");
    refuse(fmt::format("is {}, and a picture must be a PNG or JPEG; save or convert it as one, for "
                       "instance: python3 -c \"import sys; from PIL import Image; "
                       "Image.open(sys.argv[1]).save(sys.argv[2])\" IT section.png",
                       what));
}

Picture read_whole(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in)
        refuse(fmt::format("cannot be read: {}", std::strerror(errno)));
    std::error_code error;
    if (const auto size = std::filesystem::file_size(file, error); !error && size > most_bytes)
        refuse(fmt::format("has {:.1f} GB; make it smaller", 1e-9 * static_cast<double>(size)));
    Picture picture;
    picture.bytes = {std::istreambuf_iterator<char>(in), {}};
    if (picture.bytes.empty())
        refuse("is empty");
    if (picture.bytes.starts_with(signature))
        read_png(picture);
    else if (picture.bytes.starts_with(jpeg_signature))
        read_jpeg(picture);
    else
        refuse_other(picture.bytes);
    return picture;
}

} // namespace

Picture read_picture(const std::filesystem::path& file) {
    try {
        return read_whole(file);
    } catch (const UsageError& problem) {
        throw UsageError(fmt::format("{}: {}", shown(file.string()), problem.what()));
    }
}

} // namespace listric
