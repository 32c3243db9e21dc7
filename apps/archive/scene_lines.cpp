#include "apps/archive/scene_lines.hpp"

#include <sstream>

namespace listric::archive {

namespace {

/// A line of TOML without its comment and the blanks before it.
std::string_view without_comment(std::string_view line) {
    char quote = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
        const char c = line[k];
        if (quote == '"' && c == '\\')
            ++k;
        else if (quote)
            quote = c == quote ? 0 : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (c == '#') {
            line = line.substr(0, k);
            break;
        }
    }
    return line.substr(0, line.find_last_not_of(' ') + 1);
}

} // namespace

std::vector<std::string> scene_lines(std::string_view text) {
    std::vector<std::string> lines;
    std::istringstream in{std::string(text)};
    for (std::string line; std::getline(in, line);)
        if (const std::string_view said = without_comment(line);
            !said.empty() && !said.starts_with("report = "))
            lines.emplace_back(said);
    return lines;
}

} // namespace listric::archive
