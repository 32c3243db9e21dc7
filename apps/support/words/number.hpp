#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace listric {

/// The finite number that a text is, in every locale: digits with a point, a sign, and an exponent
/// after e or, as Fortran writes it, d. Blanks around it do no harm; a number too near to zero is
/// 0.
std::optional<double> parse_number(std::string_view text);

/// Objection to a text that is no number, and the cure: "a decimal comma; write 1012.75". Empty
/// where nobody can tell.
std::string number_objection(std::string_view text);

/// A length as people write it, or the objection to it and the cure.
struct Length {
    double metres = 0.0;
    std::string objection = {}; ///< empty: there is none
};

/// "5km" or "5000m". A number without a unit may mean either, so that none but 0 is taken.
Length read_length(std::string_view text);

/// "\"1012,75\" is not a finite number: a decimal comma; write 1012.75"
std::string no_number(std::string_view text);

} // namespace listric
