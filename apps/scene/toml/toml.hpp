#pragma once

#include "apps/scene/parameters/parameter.hpp"

// Without its assertions the parser reports a stray bracket where a value should be; with them
// toml++ 3.3 ends the program.
#define TOML_ASSERT(condition) static_assert(true)

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

// TOML text on one side, declared parameters (parameter.hpp) on the other. All that fails
// throws a SceneError of one line: "file:line: parameter: what is wrong, what is allowed".

namespace listric {

/// A value of the document and the path of keys that leads to it.
struct Entry {
    const toml::node& node;
    std::string path;
};

[[noreturn]] void fail(std::string message);
[[noreturn]] void fail(const Entry& entry, std::string_view message);
[[noreturn]] void fail_type(const Entry& entry, std::string_view allowed);

/// A string as TOML writes it.
std::string quoted(const std::string& string);

/// A float as TOML writes it: it has a point or an exponent.
std::string toml_float(double x);

/// Reads an entry into the object whose parameter it is.
void read(const Entry& entry, const Parameter& parameter, void* object);

/// Reads a table: every key must be declared, every parameter without a default given.
/// @param read_elsewhere  keys that are allowed besides
void read_table(const Entry& entry, const std::vector<Parameter>& parameters, void* object,
                const std::vector<std::string_view>& read_elsewhere = {});

/// Whether a parameter has no default that it could keep.
bool must_be_given(const Parameter& parameter, const void* object);

/// `origin` is where messages say that the text comes from.
toml::table parse(const std::string& text, const std::string& origin);

/// `assignment` is "table.key=value"; a value that is not TOML is a string.
void set(toml::table& document, const std::string& assignment, const std::string& origin);

/// A parameter's value as TOML; empty: none.
std::string value_text(const Parameter& parameter, const void* object);

/// Lines "key = value  # doc".
std::string write(const std::vector<Parameter>& parameters, const void* object);

/// The shortest number in units of the key that reads back as the same SI value, if there is any:
/// of two units, one may have fewer doubles around a value.
double in_key_units(double si, double per_si);

/// "number in m; at least 0.001, at most 1e6; symbol r_d"
std::string facts(const Parameter& parameter);

/// The value in `object` as TOML, or why there is none: "(required)", "(none)".
std::string default_text(const Parameter& parameter, const void* object);

/// A parameter of the reference: a line with its default, the value in `object`, others
/// with meaning, what it changes, type and range.
std::string explain(const Parameter& parameter, const void* object);

} // namespace listric
