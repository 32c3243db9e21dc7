#pragma once

#include "dem/column.hpp"
#include "dem/ranks/ranks.hpp"

#include <cassert>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace listric::dem {

/// Puts plain values one after the other.
class BytesOut {
public:
    /// Takes memory for this number of bytes at once.
    void reserve(std::size_t bytes) { bytes_.reserve(bytes); }

    template <class T> void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(&value, sizeof value);
    }
    template <class T> void add(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(values.size());
        append(values.data(), values.size_bytes());
    }
    template <class T> void add(const std::vector<T>& values) { add(std::span<const T>(values)); }
    void add(std::string_view text) { add(std::span<const char>(text.data(), text.size())); }

    Bytes take() { return std::move(bytes_); }

private:
    void append(const void* from, std::size_t size) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + size);
        if (size > 0)
            std::memcpy(bytes_.data() + at, from, size);
    }

    Bytes bytes_;
};

/// Takes them in the same order.
class BytesIn {
public:
    explicit BytesIn(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <class T> T take() {
        T value;
        copy(&value, sizeof value);
        return value;
    }
    template <class T> std::vector<T> take_all() {
        std::vector<T> values(take<std::size_t>());
        copy(values.data(), values.size() * sizeof(T));
        return values;
    }
    std::string take_text() {
        const std::vector<char> messages = take_all<char>();
        return {messages.begin(), messages.end()};
    }

private:
    void copy(void* to, std::size_t size) {
        assert(at_ + size <= bytes_.size());
        if (size > 0)
            std::memcpy(to, bytes_.data() + at_, size);
        at_ += size;
    }

    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
};

/// Rows of a table, of all columns or of those that are wanted.
Table selected(const Table& table, std::span<const std::int32_t> rows,
               bool (*is_wanted)(std::string_view column) = nullptr);

/// Adds the rows of a table to another with the same columns.
void append_rows(const Table& rows, Table& to);

/// Bytes that add_table() adds, about.
std::size_t byte_count(const Table& table);

/// All of a table as bytes, and back.
void add_table(const Table& table, BytesOut& to);
Table take_table(BytesIn& from);

} // namespace listric::dem
