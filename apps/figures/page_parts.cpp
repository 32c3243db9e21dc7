#include "apps/figures/page_parts.hpp"

namespace listric {

namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

} // namespace

std::string as_script(std::string text) {
    replace_all(text, "</script", "<\\/script");
    return text;
}

std::string as_data(std::string text) {
    replace_all(text, "<", "\\u003c");
    return text;
}

std::string filled_page(const std::string& frame, const std::map<std::string, std::string>& parts) {
    std::string html;
    std::size_t at = 0;
    for (std::size_t open = frame.find("{{"); open != frame.npos; open = frame.find("{{", at)) {
        const std::size_t close = frame.find("}}", open);
        html += frame.substr(at, open - at) + parts.at(frame.substr(open + 2, close - open - 2));
        at = close + 2;
    }
    return html + frame.substr(at);
}

} // namespace listric
