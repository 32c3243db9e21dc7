#pragma once

#include "apps/scene/picks/observed.hpp"

#include <span>
#include <string>
#include <vector>

namespace listric {

/// Lines whose pieces are together, as what has one name is compared.
std::vector<PickedLine> by_name(std::span<const PickedLine> pieces);

/// Warnings of lines that turn back by more than 90 degrees, as pieces do that a file does not
/// part; with file and line.
std::vector<std::string> turns_back(const PickedFile& picked);

} // namespace listric
