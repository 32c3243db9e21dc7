#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// A kind of file that the program ships in a folder, and users write too.
struct Shelf {
    std::string_view kind;     ///< scene
    std::string_view contents; ///< least content of such a file, named where it is empty
    const char* variable;      ///< of the environment: another folder
    std::string_view folder;   ///< in resource_folder()

    std::filesystem::path path() const;
    std::vector<std::string> names() const; ///< of the files on it, sorted
    /// The file that a name on the shelf or a path means.
    std::filesystem::path find(const std::string& name_or_path) const;
    /// Warning where a name on the shelf is also that of a file in a folder, which somebody may
    /// mean; empty: it is not.
    std::string namesake(const std::string& name_or_path,
                         const std::filesystem::path& folder) const;
};

/// Whether a file is given by its path rather than by its name on a shelf.
bool is_path(const std::string& name_or_path);

} // namespace listric
