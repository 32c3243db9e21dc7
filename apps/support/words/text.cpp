#include "apps/support/words/text.hpp"

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

/// The number of a character (its bytes are sound).
unsigned code_point(std::string_view character) {
    unsigned code = byte_at(character, 0);
    if (character.size() > 1)
        code &= 0x7fu >> character.size();
    for (std::size_t k = 1; k < character.size(); ++k)
        code = code << 6 | (byte_at(character, k) & 0x3f);
    return code;
}

struct CodeRange {
    unsigned first, last;
};

/// Characters without a column of their own, and those of two columns, in broad ranges of Unicode
/// (its tables DerivedGeneralCategory and EastAsianWidth): what is taken for wider than it is costs
/// a column, the reverse a line.
constexpr CodeRange joined[] = {
    {0x300, 0x36f}, {0x200b, 0x200f}, {0x20d0, 0x20ff}, {0xfe00, 0xfe0f}};
constexpr CodeRange wide[] = {
    {0x1100, 0x115f},   {0x231a, 0x231b},  {0x23e9, 0x23f3}, {0x25fd, 0x25fe},   {0x2600, 0x27bf},
    {0x2b1b, 0x2b55},   {0x2e80, 0xa4cf},  {0xa960, 0xa97f}, {0xac00, 0xd7ff},   {0xf900, 0xfaff},
    {0xfe10, 0xfe6f},   {0xff00, 0xff60},  {0xffe0, 0xffe6}, {0x16fe0, 0x18cff}, {0x1aff0, 0x1b2ff},
    {0x1f000, 0x1faff}, {0x20000, 0x3ffff}};

std::size_t columns_of(std::string_view character) {
    const auto is_in = [code = code_point(character)](const CodeRange& range) {
        return range.first <= code && code <= range.last;
    };
    return std::ranges::any_of(joined, is_in) ? 0 : std::ranges::any_of(wide, is_in) ? 2 : 1;
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

std::string shown_start(std::string_view text, std::size_t most) {
    if (text.size() <= most)
        return shown(text);
    while (most > 0 && (byte_at(text, most) & 0xc0) == 0x80) // not within a character
        --most;
    return shown(text.substr(0, most)) + "...";
}

std::pair<std::string, std::string> shown_apart(std::string_view one, std::string_view other) {
    constexpr std::size_t before = 20, most = 60; // bytes
    const auto [at, end] = std::ranges::mismatch(one, other);
    auto from = static_cast<std::size_t>(at - one.begin());
    from = one.size() > most || other.size() > most ? from - std::min(from, before) : 0;
    while (from > 0 && (byte_at(one, from) & 0xc0) == 0x80) // not within a character
        --from;
    const auto part = [&](std::string_view text) {
        return (from > 0 ? "..." : "") +
               shown_start(text.substr(std::min(from, text.size())), most);
    };
    return {part(one), part(other)};
}

std::string cut_to(std::string_view text, std::size_t columns) {
    constexpr std::string_view dots = "...";
    const std::size_t room = columns > 2 * dots.size() ? columns - dots.size() : columns;
    std::size_t used = 0, end = 0; // that leaves room for the dots
    for (std::size_t k = 0; k < text.size();) {
        const std::size_t length = std::max<std::size_t>(character_length(text, k), 1);
        used += columns_of(text.substr(k, length));
        if (used > columns)
            return std::string(text.substr(0, end)) + std::string(room < columns ? dots : "");
        k += length;
        if (used <= room)
            end = k;
    }
    return std::string(text);
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
