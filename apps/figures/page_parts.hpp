#pragma once

#include <map>
#include <string>
#include <string_view>

namespace listric {

// Pages for a browser: one file that asks for no other, put together from a frame and its parts.

/// A script that no tag can end that stands within it.
std::string as_script(std::string text);

/// JSON in which nothing looks like a tag.
std::string as_data(std::string text);

/// The frame with its parts in place of their names in double braces. Throws std::out_of_range if
/// the frame names a part that is not there.
std::string filled_page(const std::string& frame, const std::map<std::string, std::string>& parts);

} // namespace listric
