#include "apps/support/machine/resources.hpp"

#include <cstdlib>
#include <system_error>

namespace listric {

namespace fs = std::filesystem;

namespace {

/// Beside the folder of the executable.
fs::path installed_folder() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    return program.parent_path().parent_path() / "share/listric";
}

} // namespace

bool is_installed() {
    std::error_code error;
    return fs::is_directory(installed_folder(), error);
}

fs::path resource_folder() {
    if (const char* share = std::getenv("LISTRIC_SHARE"); share && *share)
        return share;
    return is_installed() ? installed_folder() : fs::path(LISTRIC_SOURCE_DIR) / "apps";
}

fs::path record_folder() {
    if (const char* other = std::getenv("LISTRIC_RECORDS"); other && *other)
        return other;
    std::error_code error;
    const fs::path beside = resource_folder() / "records";
    return fs::is_directory(beside, error) ? beside : fs::path(LISTRIC_SOURCE_DIR) / "apps/records";
}

} // namespace listric
