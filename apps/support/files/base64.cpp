#include "apps/support/files/base64.hpp"

#include <cstdint>
#include <string_view>

namespace listric {

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
