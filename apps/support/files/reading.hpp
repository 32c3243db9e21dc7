#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace listric {

// What is read of files, all through here: by their paths, from the disk, or from texts in its
// place.

/// Texts in place of files: while it lives, this thread finds them under their paths before it
/// looks at the disk. A page has no disk, and a test or another program may want none.
class GivenTexts {
public:
    explicit GivenTexts(const std::map<std::string, std::string>& text_by_path = {});
    ~GivenTexts();
    GivenTexts(const GivenTexts&) = delete;
    GivenTexts& operator=(const GivenTexts&) = delete;

    void give(const std::filesystem::path& path, std::string text);
    const std::string* at(const std::filesystem::path& path) const; ///< null: there is none
    std::vector<std::filesystem::path> in(const std::filesystem::path& folder) const;

private:
    std::map<std::filesystem::path, std::string> texts_;
    const GivenTexts* before_;
};

/// As std::filesystem::status().
std::filesystem::file_status status_of(const std::filesystem::path& path, std::error_code& error);
bool is_file(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);

/// Whether a name is there but of no regular file, nor of a folder: of a pipe or a device, which
/// may never end, or never begin.
bool is_pipe_or_device(const std::filesystem::path& path);

/// What is in a folder, in no order.
std::vector<std::filesystem::path> list_folder(const std::filesystem::path& folder,
                                               std::error_code& error);

/// A file up to so many bytes; none where it cannot be read, and errno says why.
std::optional<std::string> first_bytes(const std::filesystem::path& path, std::size_t most);

/// All of a file. Throws StorageError.
std::string read_text(const std::filesystem::path& path);

/// All of a file; empty if it cannot be read.
std::string read_text_if_there(const std::filesystem::path& path);

} // namespace listric
