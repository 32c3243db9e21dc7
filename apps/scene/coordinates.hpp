#pragma once

#include "apps/support/words/spelling.hpp"

#include <cmath>
#include <string>

namespace listric {

/// A coordinate in a message, to the millimetre: what follows is arithmetic's.
inline std::string to_millimetres(double metres) { return text(std::round(1e3 * metres) / 1e3); }

} // namespace listric
