#include "apps/support/files/picture.hpp"

#include "apps/support/error.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

namespace listric {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view signature = "\x89PNG\r\n\x1a\n"sv;
constexpr std::string_view jpeg_signature = "\xff\xd8\xff"sv;
constexpr std::uintmax_t most_bytes = 1'000'000'000;
constexpr std::size_t around_data = 12; ///< bytes of a chunk's length, name and checksum

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

/// Bits of a pixel; none if the standard has no such picture.
std::optional<unsigned> bits_of_pixel(unsigned depth, unsigned colour) {
    const bool whole = depth == 8 || depth == 16, part = depth == 1 || depth == 2 || depth == 4;
    switch (colour) {
    case 0: // grey
        return whole || part ? std::optional(depth) : std::nullopt;
    case 3: // of a palette
        return depth == 8 || part ? std::optional(depth) : std::nullopt;
    case 2: // red, green, blue
        return whole ? std::optional(3 * depth) : std::nullopt;
    case 4: // grey and opacity
        return whole ? std::optional(2 * depth) : std::nullopt;
    case 6:
        return whole ? std::optional(4 * depth) : std::nullopt;
    default:
        return std::nullopt;
    }
}

/// Counts what a stream of zlib's format unpacks to.
class Counter {
public:
    Counter() { good_ = inflateInit(&stream_) == Z_OK; }
    ~Counter() { inflateEnd(&stream_); }
    Counter(const Counter&) = delete;
    Counter& operator=(const Counter&) = delete;

    void add(std::string_view packed) {
        std::array<unsigned char, 65536> out;
        // zlib does not write to its input; its type is older than const.
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
        stream_.next_in = reinterpret_cast<unsigned char*>(const_cast<char*>(packed.data()));
        stream_.avail_in = static_cast<unsigned>(packed.size());
        while (good_ && !ended_ && stream_.avail_in > 0) {
            stream_.next_out = out.data();
            stream_.avail_out = out.size();
            const int code = inflate(&stream_, Z_NO_FLUSH);
            good_ = code == Z_OK || code == Z_STREAM_END;
            ended_ = code == Z_STREAM_END;
            bytes_ += static_cast<double>(out.size() - stream_.avail_out);
            good_ = good_ && bytes_ <= 16.0 * most_pixels;
        }
    }
    bool ended() const { return good_ && ended_; }
    double bytes() const { return bytes_; }

private:
    z_stream stream_ = {};
    bool good_ = false, ended_ = false;
    double bytes_ = 0.0;
};

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

class PngReader {
public:
    explicit PngReader(Picture& picture) : png_(picture) {}

    void read() {
        png_.type = "png";
        read_header();
        read_chunks();
    }

private:
    [[noreturn]] static void refuse_broken(const std::string& how) { refuse_damaged("PNG", how); }

    void read_header() {
        const std::string_view bytes = png_.bytes;
        if (bytes.size() < signature.size() + around_data + 13 ||
            bytes.substr(signature.size() + 4, 4) != "IHDR" || number_at(bytes, 8) != 13)
            refuse_broken("it does not begin with its size");
        const double width = number_at(bytes, 16), height = number_at(bytes, 20);
        const auto bits = bits_of_pixel(static_cast<unsigned char>(bytes[24]),
                                        static_cast<unsigned char>(bytes[25]));
        if (width < 1.0 || height < 1.0 || !bits)
            refuse_broken("its size or its colours are none that a PNG has");
        require_size(width, height);
        png_.width = static_cast<int>(width);
        png_.height = static_cast<int>(height);
        if (bytes[28] == 0) // rows one after the other, each with its filter
            needed_ = height * (1.0 + std::ceil(width * *bits / 8.0));
    }

    void read_chunks() {
        const std::string_view bytes = png_.bytes;
        Counter pixels;
        for (std::size_t at = signature.size(); bytes.size() - at >= around_data;) {
            const std::size_t length = number_at(bytes, at);
            if (length > bytes.size() - at - around_data)
                break;
            const std::string_view name = bytes.substr(at + 4, 4);
            const auto* const data = reinterpret_cast<const unsigned char*>(&bytes[at + 4]);
            if (crc32(0, data, static_cast<unsigned>(length + 4)) !=
                number_at(bytes, at + 8 + length))
                refuse_broken(fmt::format("the checksum of {} is wrong", shown(name)));
            if (name == "IDAT")
                pixels.add(bytes.substr(at + 8, length));
            at += around_data + length;
            if (name != "IEND")
                continue;
            if (!pixels.ended() || pixels.bytes() < needed_)
                refuse_broken("pixels are missing");
            return;
        }
        refuse_broken("its end is missing");
    }

    Picture& png_;
    double needed_ = 1.0; ///< bytes of all rows, unpacked
};

class JpegReader {
public:
    explicit JpegReader(Picture& picture) : jpeg_(picture), bytes_(picture.bytes) {}

    void read() {
        jpeg_.type = "jpeg";
        for (std::size_t at = 2;;) { // after the mark of its start
            const unsigned mark = next_mark(at);
            if (mark == end) {
                if (jpeg_.width == 0 || !has_scan_)
                    refuse_broken("pixels are missing");
                return;
            }
            if (bytes_.size() - at < 2 || length_at(at) < 2 || length_at(at) > bytes_.size() - at)
                refuse_broken("a part of it ends too early");
            const std::string_view segment = bytes_.substr(at + 2, length_at(at) - 2);
            at += length_at(at);
            if (is_frame(mark))
                read_frame(mark, segment);
            if (mark != scan)
                continue;
            has_scan_ = true;
            skip_pixels(at);
        }
    }

private:
    static constexpr unsigned end = 0xd9, scan = 0xda;

    [[noreturn]] static void refuse_broken(const std::string& how) { refuse_damaged("JPEG", how); }

    unsigned byte_at(std::size_t at) const { return static_cast<unsigned char>(bytes_[at]); }
    std::size_t length_at(std::size_t at) const { return byte_at(at) << 8 | byte_at(at + 1); }

    /// The mark at a place, which may have bytes of 255 before it; the place after it.
    unsigned next_mark(std::size_t& at) const {
        if (at >= bytes_.size())
            refuse_broken("its end is missing");
        if (byte_at(at) != 0xff)
            refuse_broken("no part begins where the last one ends");
        while (at < bytes_.size() && byte_at(at) == 0xff)
            ++at;
        if (at == bytes_.size())
            refuse_broken("its end is missing");
        return byte_at(at++);
    }

    /// Marks c0 to cf begin a frame, but for tables (c4, cc) and a reserved one (c8).
    static bool is_frame(unsigned mark) {
        return mark >= 0xc0 && mark <= 0xcf && mark != 0xc4 && mark != 0xc8 && mark != 0xcc;
    }

    void read_frame(unsigned mark, std::string_view segment) {
        if (segment.size() < 6)
            refuse_broken("its size is missing");
        if (mark > 0xc2 || segment[0] != 8)
            refuse("is a JPEG of a kind that browsers do not show (lossless, arithmetic or with "
                   "more than 8 bits); save it again as an ordinary JPEG or a PNG");
        const auto number = [&](std::size_t k) {
            return static_cast<unsigned char>(segment[k]) << 8 |
                   static_cast<unsigned char>(segment[k + 1]);
        };
        jpeg_.height = number(1);
        jpeg_.width = number(3);
        if (jpeg_.width == 0 || jpeg_.height == 0)
            refuse_broken("its width or height is 0");
        require_size(jpeg_.width, jpeg_.height);
    }

    /// To the mark after a scan's pixels, in which 255 stands before 0 or a mark of restart.
    void skip_pixels(std::size_t& at) const {
        for (; at + 1 < bytes_.size(); ++at)
            if (const unsigned next = byte_at(at + 1);
                byte_at(at) == 0xff && next != 0 && (next < 0xd0 || next > 0xd7))
                return;
        at = bytes_.size();
    }

    Picture& jpeg_;
    std::string_view bytes_;
    bool has_scan_ = false;
};

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
        PngReader(picture).read();
    else if (picture.bytes.starts_with(jpeg_signature))
        JpegReader(picture).read();
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
