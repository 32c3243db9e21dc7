#include "apps/scene/toml/toml_depth.hpp"

#include <algorithm>

namespace listric {

namespace {

/// The end of a string that begins at `begin` with a quote; of one line, unless it has three.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
    const char quote = text[begin];
    const auto is_triple = [&](std::size_t k) {
        return text.size() - k >= 3 && text[k] == quote && text[k + 1] == quote &&
               text[k + 2] == quote;
    };
    const bool is_long = is_triple(begin);
    for (std::size_t k = begin + (is_long ? 3 : 1); k < text.size(); ++k) {
        if (quote == '"' && text[k] == '\\')
            ++k;
        else if (!is_long && (text[k] == quote || text[k] == '\n'))
            return k + (text[k] == quote);
        else if (is_long && is_triple(k)) {
            k += 3;
            for (int more = 0; more < 2 && k < text.size() && text[k] == quote; ++more)
                ++k; // quotes of the string before those that end it
            return k;
        }
    }
    return text.size();
}

} // namespace

std::optional<std::size_t> too_deep_line(std::string_view text) {
    std::size_t line = 1, depth = 0, dots = 0;
    for (std::size_t k = 0; k < text.size();) {
        const char c = text[k];
        std::size_t next = k + 1;
        if (c == '"' || c == '\'')
            next = end_of_string(text, k);
        else if (c == '#')
            next = std::min(text.find('\n', k), text.size());
        else if (c == '.')
            ++dots;
        else if (c == '[' || c == '{')
            ++depth;
        else if ((c == ']' || c == '}') && depth > 0)
            --depth;
        if (c == '[' || c == ']' || c == '{' || c == '}' || c == '=' || c == ',' || c == '\n')
            dots = 0; // of the key that begins
        if (depth > deepest_toml || dots > deepest_toml)
            return line;
        line += static_cast<std::size_t>(std::count(text.data() + k, text.data() + next, '\n'));
        k = next;
    }
    return std::nullopt;
}

} // namespace listric
