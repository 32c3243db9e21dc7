#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace listric {

/// Tokens of an attribute of a drawing, one piece after the other: numbers, letters and words
/// as SVG 1.1 writes them (sections 4.2 and 8.3.9), in every locale. Throws SceneError.
class SvgText {
public:
    /// @param where  stands before what is wrong
    SvgText(std::string_view text, std::string where) : text_(text), where_(std::move(where)) {}

    bool at_end();

    /// The next letter, if one is next.
    std::optional<char> letter();

    /// The letters, digits and hyphens that are next; may be empty.
    std::string_view word();

    /// The letters that stand right after a number; may be none.
    std::string_view unit();

    /// Takes a mark, if it is next.
    bool takes(char mark);

    /// A number; one comma may be between it and the number before.
    double number();

    /// A flag of an elliptic arc, which needs nothing between it and what follows.
    bool flag();

    [[noreturn]] void refuse(std::string_view what) const;

private:
    void skip_blanks();
    void skip_comma();
    [[noreturn]] void refuse_here(std::string_view missing) const;

    std::string_view text_;
    std::string where_;
    std::size_t at_ = 0;
    bool after_number_ = false;
};

} // namespace listric
