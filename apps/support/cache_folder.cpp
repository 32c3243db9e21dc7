#include "apps/support/cache_folder.hpp"

#include <cstdlib>

namespace listric {

namespace fs = std::filesystem;

fs::path cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    const fs::path folder = cache && *cache ? fs::path(cache)
                            : home && *home ? fs::path(home) / ".cache"
                                            : fs::temp_directory_path();
    return folder / "listric";
}

} // namespace listric
