#pragma once

#include "apps/archive/folder/json_file.hpp"

#include <string>

namespace listric::archive {

/// Errors that a summary knows, in one sentence; empty where it is older than that.
std::string error_sentence(const JsonObject& summary);

} // namespace listric::archive
