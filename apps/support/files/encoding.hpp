#pragma once

#include <span>
#include <string>
#include <vector>

namespace listric {

/// Bytes in zlib's format (RFC 1950). @param level  0 (stored) to 9 (smallest)
/// Throws std::invalid_argument for another level, std::bad_alloc.
std::vector<unsigned char> deflated(std::span<const unsigned char> bytes, int level);

/// Bytes as text of RFC 4648, section 4: with padding, in one line.
std::string base64(std::span<const unsigned char> bytes);

} // namespace listric
