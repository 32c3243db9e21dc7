#include "apps/support/files/encoding.hpp"

#include <cstdint>
#include <new>
#include <stdexcept>
#include <string_view>
#include <zlib.h>

namespace listric {

std::vector<unsigned char> deflated(std::span<const unsigned char> bytes, int level) {
    if (level < 0 || level > 9)
        throw std::invalid_argument("deflated: level is not 0 to 9");
    uLongf size = compressBound(bytes.size());
    std::vector<unsigned char> result(size);
    // With so much room only memory can be short.
    if (compress2(result.data(), &size, bytes.data(), bytes.size(), level) != Z_OK)
        throw std::bad_alloc();
    result.resize(size);
    return result;
}

std::string base64(std::span<const unsigned char> bytes) {
    constexpr std::string_view letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        std::uint32_t group = 0; // three bytes, four letters of six bits
        for (std::size_t i = k; i < k + 3; ++i)
            group = group << 8 | (i < bytes.size() ? bytes[i] : 0u);
        for (int shift = 18; shift >= 0; shift -= 6)
            text += letters[group >> shift & 63];
    }
    const std::size_t padding = (3 - bytes.size() % 3) % 3;
    text.replace(text.size() - padding, padding, padding, '=');
    return text;
}

} // namespace listric
