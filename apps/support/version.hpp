#pragma once

#include <string_view>

namespace listric {

extern const std::string_view version;         ///< project version + git commit, if known
extern const std::string_view source_hash;     ///< of everything in dem: same hash, same physics
extern const std::string_view measures_hash;   ///< of everything in apps/measures: same definitions
extern const std::string_view compiler;        ///< name and version
extern const std::string_view build_flags;     ///< as given to the compiler
extern const std::string_view instruction_set; ///< widest vectors that the compiler may use

} // namespace listric
