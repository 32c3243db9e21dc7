#include "apps/support/resources.hpp"

#include <cstdlib>
#include <system_error>

namespace listric {

namespace fs = std::filesystem;

fs::path resource_folder() {
    if (const char* share = std::getenv("LISTRIC_SHARE"); share && *share)
        return share;
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const fs::path installed = program.parent_path().parent_path() / "share/listric";
    return fs::is_directory(installed, error) ? installed : fs::path(LISTRIC_SOURCE_DIR) / "apps";
}

} // namespace listric
