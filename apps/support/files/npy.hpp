#pragma once

#include "apps/support/error.hpp"

#include <cassert>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <type_traits>

namespace listric {

/// Writes values as a NumPy array (format version 1.0, little endian), with `columns` > 0 as a
/// matrix of that many columns. Throws StorageError.
template <class T>
void write_npy(const std::filesystem::path& path, std::span<const T> values,
               std::size_t columns = 0) {
    assert(columns == 0 || values.size() % columns == 0);
    const char kind = std::is_floating_point_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u';
    const std::string shape =
        columns == 0 ? std::to_string(values.size()) + ","
                     : std::to_string(values.size() / columns) + ", " + std::to_string(columns);
    std::string header = std::string("{'descr': '<") + kind + std::to_string(sizeof(T)) +
                         "', 'fortran_order': False, 'shape': (" + shape + "), }";
    header.resize((header.size() + 11 + 63) / 64 * 64 - 11, ' ');
    header += '\n';
    errno = 0;
    std::ofstream out(path, std::ios::binary);
    out.write("\x93NUMPY\x01\x00", 8);
    out.put(static_cast<char>(header.size() & 0xff));
    out.put(static_cast<char>(header.size() >> 8));
    out << header;
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size_bytes()));
    if (!out.flush())
        throw StorageError(path.string() +
                           ": cannot be written: " + std::strerror(errno ? errno : EIO));
}

} // namespace listric
