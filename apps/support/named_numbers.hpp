#pragma once

#include <string>
#include <utility>
#include <vector>

namespace listric {

/// Numbers by the names of docs/measures.md, in the order in which they are shown. What has no
/// meaning is absent.
using NamedNumbers = std::vector<std::pair<std::string, double>>;

} // namespace listric
