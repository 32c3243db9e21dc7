#include "apps/support/words/pattern.hpp"

#include <regex>

namespace listric {

bool is_match(const std::string& text, const char* expression) {
    return std::regex_match(text, std::regex(expression));
}

bool is_match_in_any_case(const std::string& text, const char* expression) {
    return std::regex_match(text,
                            std::regex(expression, std::regex::ECMAScript | std::regex::icase));
}

std::optional<std::vector<std::string>> parts_of(const std::string& text, const char* expression) {
    std::smatch parts;
    if (!std::regex_match(text, parts, std::regex(expression)))
        return std::nullopt;
    return std::vector<std::string>(parts.begin(), parts.end());
}

std::vector<Found> find_all(const std::string& text, const char* expression) {
    std::vector<Found> all;
    const std::regex pattern(expression);
    for (std::sregex_iterator found(text.begin(), text.end(), pattern), end; found != end; ++found)
        all.push_back({static_cast<std::size_t>(found->position()),
                       static_cast<std::size_t>(found->length())});
    return all;
}

} // namespace listric
