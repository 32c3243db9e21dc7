#include "apps/archive/comment.hpp"

namespace listric::archive {

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

} // namespace listric::archive
