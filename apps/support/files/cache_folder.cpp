#include "apps/support/files/cache_folder.hpp"

#include <cstdlib>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace listric {

namespace fs = std::filesystem;

namespace {

/// A folder of this user's among everybody's temporary files; empty: it is another's, who may
/// change what is kept there.
fs::path own_temporary_folder() {
    std::error_code error;
    const fs::path temporary = fs::temp_directory_path(error);
    const fs::path folder = temporary / ("listric-" + std::to_string(geteuid()));
    mkdir(folder.c_str(), 0700);
    struct stat facts {};
    const bool is_own = !error && lstat(folder.c_str(), &facts) == 0 && S_ISDIR(facts.st_mode) &&
                        facts.st_uid == geteuid() && (facts.st_mode & (S_IWGRP | S_IWOTH)) == 0;
    return is_own ? folder : fs::path();
}

} // namespace

fs::path cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    return cache && *cache ? fs::path(cache) / "listric"
           : home && *home ? fs::path(home) / ".cache/listric"
                           : own_temporary_folder();
}

} // namespace listric
