#include "apps/archive/snapshot/checksum.hpp"

#include "apps/support/error.hpp"
#include "dem/numbers/hash.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

namespace listric::archive {

namespace {

constexpr std::string_view checksum_mark = "listric checksum"; // 16 bytes, 8 more are the sum
constexpr std::size_t checksum_bytes = checksum_mark.size() + sizeof(std::uint64_t);

std::uint64_t checksum(std::span<const std::byte> bytes) {
    std::uint64_t sum = bytes.size();
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(bytes.size(), sizeof sum))) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data(), std::min(bytes.size(), sizeof word));
        sum = dem::chained(sum, word); // one to one: no damage to a single word goes unseen
    }
    return sum;
}

std::vector<std::byte> read_bytes(const std::filesystem::path& path) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error); // of plain files alone
    if (error)
        throw UnreadableFile("cannot be read: " + error.message());
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    std::vector<std::byte> bytes(size);
    if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw UnreadableFile(std::string("cannot be read: ") + std::strerror(errno ? errno : EIO));
    return bytes;
}

} // namespace

void append_checksum(std::vector<std::byte>& bytes) {
    const std::uint64_t sum = checksum(bytes);
    const auto mark = std::as_bytes(std::span(checksum_mark));
    const auto word = std::as_bytes(std::span(&sum, 1));
    bytes.insert(bytes.end(), mark.begin(), mark.end());
    bytes.insert(bytes.end(), word.begin(), word.end());
}

bool verify_checksum(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = read_bytes(path);
    if (bytes.size() < checksum_bytes)
        throw StorageError("is not a snapshot");
    const std::span content(bytes.data(), bytes.size() - checksum_bytes);
    const std::byte* const mark = content.data() + content.size();
    if (std::memcmp(mark, checksum_mark.data(), checksum_mark.size()) != 0)
        return false;
    std::uint64_t sum = 0;
    std::memcpy(&sum, mark + checksum_mark.size(), sizeof sum);
    if (sum != checksum(content))
        throw StorageError("is damaged (its bytes do not match their checksum)");
    return true;
}

} // namespace listric::archive
