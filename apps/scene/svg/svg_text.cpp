#include "apps/scene/svg/svg_text.hpp"

#include "apps/support/error.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <charconv>

namespace listric {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

} // namespace

void SvgText::skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_]))
        ++at_;
}

void SvgText::skip_comma() {
    skip_blanks();
    if (after_number_ && at_ < text_.size() && text_[at_] == ',')
        ++at_;
    skip_blanks();
    after_number_ = false;
}

bool SvgText::at_end() {
    skip_blanks();
    return at_ == text_.size();
}

std::optional<char> SvgText::letter() {
    skip_blanks();
    if (at_ == text_.size() || !is_letter(text_[at_]))
        return std::nullopt;
    after_number_ = false;
    return text_[at_++];
}

std::string_view SvgText::word() {
    skip_blanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '-'))
        ++at_;
    return text_.substr(begin, at_ - begin);
}

std::string_view SvgText::unit() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_letter(text_[at_]))
        ++at_;
    return text_.substr(begin, at_ - begin);
}

bool SvgText::takes(char mark) {
    skip_blanks();
    if (at_ == text_.size() || text_[at_] != mark)
        return false;
    after_number_ = false;
    ++at_;
    return true;
}

double SvgText::number() {
    skip_comma();
    const std::size_t sign = at_ < text_.size() && (text_[at_] == '+' || text_[at_] == '-') ? 1 : 0;
    const std::size_t first = at_ + sign;
    // from_chars would take inf and nan, too, and no plus.
    if (first == text_.size() || (!is_digit(text_[first]) && text_[first] != '.'))
        refuse_here("a number");
    double value = 0.0;
    const char* begin = text_.data() + first;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error == std::errc::result_out_of_range) {
        const std::string_view digits(begin, static_cast<std::size_t>(end - begin));
        if (digits.find("e-") == digits.npos && digits.find("E-") == digits.npos)
            refuse(fmt::format("{} is too large a number", digits.substr(0, 40)));
        value = 0.0; // so near to it
    } else if (error != std::errc{}) {
        refuse_here("a number");
    }
    if (text_[at_] == '-')
        value = -value;
    at_ = static_cast<std::size_t>(end - text_.data());
    after_number_ = true;
    return value;
}

bool SvgText::flag() {
    skip_comma();
    if (at_ == text_.size() || (text_[at_] != '0' && text_[at_] != '1'))
        refuse_here("a flag, 0 or 1,");
    after_number_ = true;
    return text_[at_++] == '1';
}

void SvgText::refuse(std::string_view what) const {
    throw SceneError(fmt::format("{}: {}", where_, what));
}

void SvgText::refuse_here(std::string_view missing) const {
    const std::string_view there = text_.substr(at_, 12);
    refuse(there.empty() ? fmt::format("{} is missing at its end", missing)
                         : fmt::format("{} is missing at character {}, where \"{}\" stands",
                                       missing, at_ + 1, shown(there)));
}

} // namespace listric
