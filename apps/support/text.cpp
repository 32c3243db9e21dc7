#include "apps/support/text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace listric {

namespace {

unsigned byte_at(std::string_view text, std::size_t k) {
    return static_cast<unsigned char>(text[k]);
}

/// The length of the character that begins at `k`, bytes; 0 if none does (RFC 3629, section 4).
std::size_t character_length(std::string_view text, std::size_t k) {
    const unsigned first = byte_at(text, k);
    if (first < 0x80)
        return 1;
    const std::size_t length = first < 0xc2   ? 0
                               : first < 0xe0 ? 2
                               : first < 0xf0 ? 3
                               : first < 0xf5 ? 4
                                              : 0;
    if (length == 0 || text.size() - k < length)
        return 0;
    for (std::size_t j = 1; j < length; ++j)
        if ((byte_at(text, k + j) & 0xc0) != 0x80)
            return 0;
    const unsigned second = byte_at(text, k + 1);
    const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
    const bool surrogate = first == 0xed && second > 0x9f;
    const bool too_large = first == 0xf4 && second > 0x8f;
    return overlong || surrogate || too_large ? 0 : length;
}

/// Characters that a terminal obeys: those below a blank, DEL, and U+0080 to U+009F.
bool is_control(std::string_view character) {
    const unsigned first = byte_at(character, 0);
    return first < 0x20 || first == 0x7f || (first == 0xc2 && byte_at(character, 1) < 0xa0);
}

} // namespace

std::optional<std::size_t> unsound_byte(std::string_view text) {
    for (std::size_t k = 0; k < text.size();) {
        const std::size_t length = character_length(text, k);
        if (length == 0 || text[k] == '\0')
            return k;
        k += length;
    }
    return std::nullopt;
}

std::string shown(std::string_view text) {
    std::string safe;
    for (std::size_t k = 0; k < text.size();) {
        const std::size_t length = character_length(text, k);
        const std::string_view character = text.substr(k, length == 0 ? 1 : length);
        if (length > 0 && !is_control(character))
            safe += character;
        else
            for (std::size_t j = 0; j < character.size(); ++j)
                safe += fmt::format("\\x{:02x}", byte_at(character, j));
        k += character.size();
    }
    return safe;
}

std::string shown_lines(std::string_view text) {
    std::string safe;
    for (std::size_t begin = 0, end; begin <= text.size(); begin = end + 1) {
        end = std::min(text.find('\n', begin), text.size());
        safe += shown(text.substr(begin, end - begin));
        if (end < text.size())
            safe += '\n';
    }
    return safe;
}

std::string objection_to_byte(std::string_view text, std::size_t place) {
    return text[place] == '\0' ? "has a NUL byte"
                               : fmt::format("byte 0x{:02x} is not UTF-8", byte_at(text, place));
}

std::string objection_to_name(std::string_view name) {
    constexpr std::size_t longest = 200; // bytes; file systems have 255, and others add to it
    if (name.empty())
        return "is empty";
    if (name == "." || name == "..")
        return "means a folder";
    if (name.find('/') != name.npos)
        return "has a /";
    if (shown(name) != name)
        return unsound_byte(name) ? objection_to_byte(name, *unsound_byte(name))
                                  : "has a control character";
    if (name.size() > longest)
        return fmt::format("has {} bytes, at most {} fit", name.size(), longest);
    return "";
}

} // namespace listric
