#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// Names of columns as a message may hold them.
std::string header_text(const std::vector<std::string>& header);

/// Likely mistake of a header that lacks a column, and the cure: "; depth_km is in another
/// unit ...". Empty where nobody can tell.
/// @param text  of the whole file
std::string header_hint(const std::vector<std::string>& header, std::string_view missing,
                        const std::vector<std::string_view>& needed, std::string_view text);

/// Likely misnamed column in place of one that may be missing, and the cure; empty if there is
/// none: only the name with another unit, without one or in another spelling counts.
std::string optional_hint(const std::vector<std::string>& header, std::string_view missing);

} // namespace listric
