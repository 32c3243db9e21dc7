#pragma once

#include "apps/scene/declaration.hpp"

// Without its assertions the parser reports a stray bracket where a value should be; with them
// toml++ 3.3 ends the program.
#define TOML_ASSERT(condition) static_assert(true)

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// TOML text on one side, declared parameters (apps/declaration.hpp) on the other. All that fails
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

/// "did you mean mean_radius_m?", or else all that is allowed.
std::string advice(std::string_view name, const std::vector<std::string_view>& allowed);

std::vector<std::string_view> keys(const std::vector<Parameter>& parameters);

/// Reads an entry into the variable that its parameter declares.
void read(const Entry& entry, const Parameter& parameter);

/// Reads a table: every key must be declared, every parameter without a default given.
void read_table(const Entry& entry, const std::vector<Parameter>& parameters);

/// A kind of file that the program ships in a folder, and users write too.
struct Shelf {
    std::string_view kind;     ///< scene
    std::string_view contents; ///< what such a file must have, told where it is empty
    const char* variable;      ///< of the environment: another folder
    std::string_view folder;   ///< in the source tree

    std::filesystem::path path() const;
    std::vector<std::string> names() const; ///< of the files on it, sorted
    /// The file that a name on the shelf or a path means.
    std::filesystem::path find(const std::string& name_or_path) const;
    toml::table read(const std::filesystem::path& file) const;
};

/// Whether a file is given by its path rather than by its name on a shelf.
bool is_path(const std::string& name_or_path);

/// `assignment` is "table.key=value"; a value that is not TOML is a string.
void set(toml::table& document, const std::string& assignment, const std::string& origin);

/// Lines "key = value  # doc".
std::string write(const std::vector<Parameter>& parameters);

/// A parameter of the reference: a line with the default, two with meaning, type and range.
std::string explain(const Parameter& parameter);

} // namespace listric
