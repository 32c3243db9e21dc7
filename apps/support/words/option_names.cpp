#include "apps/support/words/option_names.hpp"

#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>

#include <algorithm>
#include <cctype>

namespace listric {

namespace {

constexpr std::size_t longest = 100; ///< letters; a file's name has 255 at most
constexpr std::string_view hexadecimal = "0123456789abcdef";
constexpr std::string_view in_numbers = "0123456789e.+-", in_lists = "0123456789abcdef.+-_";

std::string short_hash(std::string_view text) {
    return fmt::format(
        "{:08x}", crc32_z(0, reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

bool take(std::string_view& rest, std::string_view begin, std::string_view letters,
          std::string_view end) {
    if (!rest.starts_with(begin))
        return false;
    const std::string_view list = rest.substr(begin.size());
    const std::size_t size = std::min(list.find_first_not_of(letters), list.size());
    if (size == 0 || !list.substr(size).starts_with(end))
        return false;
    rest = list.substr(size + end.size());
    return true;
}

} // namespace

std::string listed(const std::vector<std::string>& words) {
    const std::string all = fmt::format("{}", fmt::join(words, "_"));
    if (all.size() <= longest)
        return all;
    return fmt::format("{}_{}_{}_{}", words.front(), words.back(), words.size(), short_hash(all));
}

std::string listed(const std::vector<double>& numbers) {
    std::vector<std::string> words;
    for (const double number : numbers)
        words.push_back(text(number));
    return listed(words);
}

std::string named_after(const std::string& stem, std::string_view content) {
    std::string plain;
    for (const char letter : stem.substr(0, longest))
        plain += std::isalnum(static_cast<unsigned char>(letter)) || letter == '.' || letter == '-'
                     ? letter
                     : '_';
    return fmt::format("{}-{}", plain, short_hash(content));
}

bool take_number(std::string_view& rest, std::string_view begin, std::string_view end) {
    return take(rest, begin, in_numbers, end);
}

bool take_listed(std::string_view& rest, std::string_view begin, std::string_view end) {
    return take(rest, begin, in_lists, end);
}

bool is_named_after(std::string_view text) {
    const std::size_t dash = text.rfind('-');
    return dash != text.npos && text.size() - dash == 9 &&
           text.substr(dash + 1).find_first_not_of(hexadecimal) == text.npos;
}

} // namespace listric
