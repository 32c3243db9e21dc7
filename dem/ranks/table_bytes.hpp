#pragma once

#include "dem/column.hpp"
#include "dem/ranks/bytes.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace listric::dem {

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
