#pragma once

#include <filesystem>

namespace listric {

/// Where what took long to make is kept for later calls: XDG_CACHE_HOME, ~/.cache or the temporary
/// folder. Empty where there is none of them.
std::filesystem::path cache_folder();

} // namespace listric
