#pragma once

#include "apps/support/error.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace listric {

/// The number in a cell of a table that a call has left. Throws StorageError if it is none.
inline double number_in(const std::string& cell, const std::filesystem::path& file) {
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    if (cell.empty() || *end != '\0')
        throw StorageError(fmt::format("{}: is damaged: \"{}\" is no number", file.string(), cell));
    return value;
}

} // namespace listric
