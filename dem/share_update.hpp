#pragma once

#include "dem/ranks.hpp"
#include "dem/share.hpp"

namespace listric::dem {

struct RigidBase;

/// Updates the lists of a share as update_contacts() does those of the whole; ghosts come and go.
/// Made by all ranks.
void update_share(Share& share, const RigidBase& base, Ranks& ranks);

} // namespace listric::dem
