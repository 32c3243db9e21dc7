#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace listric {

/// The place of the first byte at which a text is no UTF-8 (RFC 3629: no overlong forms, surrogates
/// or numbers above 10FFFF) or is NUL; none where all of it is sound.
std::optional<std::size_t> unsound_byte(std::string_view text);

/// A text of somebody's as a message may hold it: control characters and bytes that are no UTF-8
/// are written as \xNN, so that a terminal obeys none of them.
std::string shown(std::string_view text);

/// The first characters of a text as shown() has them, and "..." where it goes on.
std::string shown_start(std::string_view text, std::size_t most = 60);

/// Two texts that differ, for a message: of long ones the part in which they begin to.
std::pair<std::string, std::string> shown_apart(std::string_view one, std::string_view other);

/// The beginning of a text without control characters that takes no more than so many columns of a
/// terminal; "..." for what is cut off, where there is room for that.
std::string cut_to(std::string_view text, std::size_t columns);

/// A text of several lines as shown() has it, but for their ends, which stay.
std::string shown_lines(std::string_view text);

/// Mistake at a byte that unsound_byte() found: "has a NUL byte", "byte 0xf6 is not UTF-8".
std::string objection_to_byte(std::string_view text, std::size_t place);

/// Why a text cannot be the name of one file or folder ("has a /"); empty if it can. Names of
/// folders are made of what scenes and plans say, and these travel between people.
std::string objection_to_name(std::string_view name);

} // namespace listric
