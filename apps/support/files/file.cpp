#include "apps/support/files/file.hpp"

#include "apps/support/error.hpp"
#include "apps/support/words/log.hpp"

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <unistd.h>
#include <utility>

namespace listric {

namespace fs = std::filesystem;

namespace {

/// A new file beside `path` to be written, NAME.NUMBER.part, and its name. What has such a name
/// already is somebody's, be it a link to what must not be overwritten: then another number is
/// taken. Throws StorageError.
std::pair<int, fs::path> open_part(const fs::path& path) {
    constexpr int most_tries = 1000;
    for (int k = 0; k < most_tries; ++k) {
        const std::string number = std::to_string(getpid()) + (k == 0 ? "" : std::to_string(k));
        fs::path part = path.string() + "." + number + ".part";
        const int file =
            open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file >= 0)
            return {file, std::move(part)};
        if (errno != EEXIST)
            break;
    }
    throw StorageError(path.string() + ": cannot write: " + std::strerror(errno));
}

/// Whether what was written is on the disk. Some file systems (CIFS, sshfs, others of FUSE) have no
/// call for it: then nobody knows, and people are told once.
bool is_on_disk(int file, const fs::path& path) {
    if (fsync(file) == 0)
        return true;
    if (errno != EINVAL && errno != ENOTSUP && errno != ENOSYS)
        return false;
    static std::atomic_flag told;
    if (!told.test_and_set())
        warn(path.parent_path().string() + ": this file system does not say when a file is safe; "
                                           "a loss of power may cost the newest files");
    return true;
}

} // namespace

void write_bytes(const fs::path& path, std::span<const std::byte> bytes) {
    const auto [file, temporary] = open_part(path);
    const auto fail = [&, &temporary = temporary] {
        const int cause = errno;
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw StorageError(path.string() + ": cannot write: " + std::strerror(cause));
    };
    bool good = true;
    while (good && !bytes.empty()) {
        const ssize_t written = write(file, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR)
            continue;
        good = written > 0;
        if (good)
            bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    good = good && is_on_disk(file, path);
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

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw StorageError(folder.string() + ": cannot make the folder: " + error.message());
}

TemporaryFolder::TemporaryFolder(const fs::path& where) {
    make_folder(where);
    std::string pattern = (where / ".listric-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
        throw StorageError(where.string() +
                           ": cannot make a folder in it: " + std::strerror(errno));
    path = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
}

} // namespace listric
