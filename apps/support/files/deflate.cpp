#include "apps/support/files/deflate.hpp"

#include <zlib.h>

#include <new>
#include <stdexcept>

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

} // namespace listric
