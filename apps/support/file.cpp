#include "apps/support/file.hpp"

#include "apps/support/error.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

namespace listric {

namespace fs = std::filesystem;

void write_bytes(const fs::path& path, std::span<const std::byte> bytes) {
    const fs::path temporary = path.string() + "." + std::to_string(getpid()) + ".part";
    const auto fail = [&] {
        const int cause = errno;
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw StorageError(path.string() + ": cannot write: " + std::strerror(cause));
    };
    const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0)
        fail();
    bool good = true;
    while (good && !bytes.empty()) {
        const ssize_t written = write(file, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR)
            continue;
        good = written > 0;
        if (good)
            bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    good = good && fsync(file) == 0;
    const int cause = errno;
    if (close(file) != 0 && good)
        fail();
    errno = cause;
    if (!good || rename(temporary.c_str(), path.c_str()) != 0)
        fail();
}

void write_text(const fs::path& path, std::string_view text) {
    write_bytes(path, std::as_bytes(std::span(text)));
}

bool is_pipe_or_device(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

std::string read_text(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in)
        throw StorageError(path.string() + ": cannot be read");
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string read_text_if_there(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw StorageError(folder.string() + ": " + error.message());
}

TemporaryFolder::TemporaryFolder(const fs::path& where) {
    fs::create_directories(where);
    std::string pattern = (where / ".data-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
        throw StorageError("cannot make a folder in " + where.string());
    path = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
}

} // namespace listric
