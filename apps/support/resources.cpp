#include "apps/support/resources.hpp"

namespace listric {

std::filesystem::path source_folder() { return LISTRIC_SOURCE_DIR; }

} // namespace listric
