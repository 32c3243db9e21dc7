#include "apps/support/cache_folder.hpp"

#include <cstdlib>
#include <system_error>

namespace listric {

namespace fs = std::filesystem;

fs::path cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    std::error_code error;
    const fs::path folder = cache && *cache ? fs::path(cache)
                            : home && *home ? fs::path(home) / ".cache"
                                            : fs::temp_directory_path(error);
    return error ? fs::path() : folder / "listric";
}

} // namespace listric
