#include "apps/support/files/reading.hpp"

#include "apps/support/error.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

namespace listric {

namespace fs = std::filesystem;

namespace {

thread_local const GivenTexts* texts_at_hand = nullptr;

const std::string* given_text(const fs::path& path) {
    return texts_at_hand ? texts_at_hand->at(path) : nullptr;
}

constexpr std::size_t all_bytes = std::string::npos;

} // namespace

GivenTexts::GivenTexts(const std::map<std::string, std::string>& text_by_path)
    : before_(std::exchange(texts_at_hand, this)) {
    for (const auto& [path, text] : text_by_path)
        give(path, text);
}

GivenTexts::~GivenTexts() { texts_at_hand = before_; }

void GivenTexts::give(const fs::path& path, std::string text) {
    texts_.insert_or_assign(path.lexically_normal(), std::move(text));
}

const std::string* GivenTexts::at(const fs::path& path) const {
    const auto found = texts_.find(path.lexically_normal());
    return found == texts_.end() ? nullptr : &found->second;
}

std::vector<fs::path> GivenTexts::in(const fs::path& folder) const {
    std::vector<fs::path> files;
    for (const auto& [path, text] : texts_)
        if (path.parent_path() == folder.lexically_normal())
            files.push_back(path);
    return files;
}

fs::file_status status_of(const fs::path& path, std::error_code& error) {
    if (!given_text(path))
        return fs::status(path, error);
    error.clear();
    return fs::file_status(fs::file_type::regular);
}

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(status_of(path, ignored));
}

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(status_of(path, ignored));
}

bool is_pipe_or_device(const fs::path& path) {
    std::error_code ignored;
    const fs::file_status status = status_of(path, ignored);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

std::vector<fs::path> list_folder(const fs::path& folder, std::error_code& error) {
    std::vector<fs::path> found;
    if (texts_at_hand)
        found = texts_at_hand->in(folder);
    if (!found.empty())
        return found;
    for (fs::directory_iterator file(folder, error), end; !error && file != end;
         file.increment(error))
        found.push_back(file->path());
    return found;
}

std::optional<std::string> first_bytes(const fs::path& path, std::size_t most) {
    if (const std::string* given = given_text(path))
        return given->substr(0, most);
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in)
        return std::nullopt;
    std::string text;
    std::array<char, 1 << 16> part; // read() does not throw where the disk fails, an iterator does
    while (text.size() < most && (in.read(part.data(), static_cast<std::streamsize>(std::min(
                                                           part.size(), most - text.size()))) ||
                                  in.gcount() > 0))
        text.append(part.data(), static_cast<std::size_t>(in.gcount()));
    return in.bad() ? std::nullopt : std::optional(std::move(text));
}

std::string read_text(const fs::path& path) {
    if (is_folder(path))
        throw StorageError(path.string() + ": cannot be read: it is a folder");
    if (auto text = first_bytes(path, all_bytes))
        return std::move(*text);
    throw StorageError(path.string() + ": cannot be read: " + std::strerror(errno ? errno : EIO));
}

std::string read_text_if_there(const fs::path& path) {
    if (!is_file(path)) // a pipe would wait for who never writes
        return "";
    return first_bytes(path, all_bytes).value_or("");
}

} // namespace listric
