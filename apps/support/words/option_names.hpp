#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace listric {

// Names of files hold the options of the call that wrote them: calls with other options write other
// files.

/// Words of a list as a part of a name: "1000_3000". A long list is told by its ends, its size and
/// a hash.
std::string listed(const std::vector<std::string>& words);
std::string listed(const std::vector<double>& numbers);

/// Part of a name after a user's file: its letters, digits, dots and dashes, others as "_", and a
/// hash of its content.
std::string named_after(const std::string& stem, std::string_view content);

/// Takes BEGIN, a number and END from the front of a name's rest; false if it does not begin so.
bool take_number(std::string_view& rest, std::string_view begin, std::string_view end);

/// As take_number(), a list as listed() writes it.
bool take_listed(std::string_view& rest, std::string_view begin, std::string_view end);

/// Whether named_after() may write that.
bool is_named_after(std::string_view text);

} // namespace listric
