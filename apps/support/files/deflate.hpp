#pragma once

#include <span>
#include <vector>

namespace listric {

/// Bytes in zlib's format (RFC 1950). @param level  0 (stored) to 9 (smallest)
/// Throws std::invalid_argument for another level, std::bad_alloc.
std::vector<unsigned char> deflated(std::span<const unsigned char> bytes, int level);

} // namespace listric
