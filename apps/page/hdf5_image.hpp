#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace listric {

// Files of HDF5 as bytes, for where its library is not: groups, numbers, texts and columns of
// numbers, as the HDF5 File Format Specification (version 3) has them with a superblock of version
// 0, headers of objects of version 1, links within these, and data in one piece.

/// A value or several: its type and shape as messages have them, and its bytes.
struct Hdf5Data {
    std::string type;
    std::optional<std::uint64_t> rows; ///< none: a single value
    std::vector<std::byte> bytes;
};

/// A group of members, or a dataset, with attributes.
struct Hdf5Object {
    std::string name = {};
    std::optional<Hdf5Data> data = {}; ///< none: a group
    std::vector<std::pair<std::string, Hdf5Data>> attributes = {};
    std::list<Hdf5Object> members = {}; ///< stay where they are as others come

    Hdf5Object& add(std::string member, std::optional<Hdf5Data> its = {});
};

/// A text. @param is_utf8  else of no character set, as C's
Hdf5Data hdf5_text(std::string_view text, bool is_utf8);

/// The message of a type of numbers.
std::string hdf5_number_type(std::size_t bytes, bool is_float, bool is_signed);

/// A number; a double, a float, or an integer.
template <class T> Hdf5Data hdf5_number(const T& value) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(&value);
    return {hdf5_number_type(sizeof value, std::is_floating_point_v<T>, std::is_signed_v<T>),
            {},
            {bytes, bytes + sizeof value}};
}

template <class T> Hdf5Data hdf5_column(const std::vector<T>& values) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(values.data());
    return {hdf5_number_type(sizeof(T), std::is_floating_point_v<T>, std::is_signed_v<T>),
            values.size(),
            {bytes, bytes + values.size() * sizeof(T)}};
}

std::vector<std::byte> hdf5_image(const Hdf5Object& root);

} // namespace listric
