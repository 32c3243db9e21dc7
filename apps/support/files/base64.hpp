#pragma once

#include <span>
#include <string>

namespace listric {

/// Bytes as text of RFC 4648, section 4: with padding, in one line.
std::string base64(std::span<const unsigned char> bytes);

} // namespace listric
