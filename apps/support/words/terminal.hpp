#pragma once

#include <cstddef>

namespace listric {

/// Columns for people: as COLUMNS has them, else of the terminal that standard error or output is
/// now, for a window may have been resized; else 80.
std::size_t terminal_columns();

} // namespace listric
