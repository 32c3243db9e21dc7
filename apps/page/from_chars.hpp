// For every unit of the module: the one function of C++20 that the rooms call and libc++ has only
// from 20 on.
#pragma once

#include <version>

#if !defined __cpp_lib_to_chars

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>
#include <system_error>

namespace std {

inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    // A number has no blank, plus or 0x before it.
    const string text(first, last);
    const size_t sign = text.starts_with('-');
    const size_t length = text.find_first_of("xX");
    if (text.size() == sign || string_view("0123456789.in").find(text[sign]) == string_view::npos)
        return {first, errc::invalid_argument};
    const string number = text.substr(0, length);
    char* end = nullptr;
    errno = 0;
    const double read = strtod(number.c_str(), &end);
    if (end == number.c_str())
        return {first, errc::invalid_argument};
    const char* const stopped = first + (end - number.c_str());
    if (errno == ERANGE && (read == 0.0 || isinf(read)))
        return {stopped, errc::result_out_of_range};
    value = read;
    return {stopped, errc{}};
}

} // namespace std

#endif
