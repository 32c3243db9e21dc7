#pragma once

#include "dem/ranks/ranks.hpp"
#include "dem/ranks/subdomain.hpp"

namespace listric::dem {

struct RigidBase;

/// Updates the lists of a subdomain as update_contacts() does those of the whole. Discs that have
/// come near those of another rank become ghosts, and stay so until subdomains are cut anew; pairs
/// of ghosts may be listed, and change nothing. Made by all ranks; returns whether any has new
/// ghosts.
bool update_subdomain(Subdomain& subdomain, const RigidBase& base, Ranks& ranks);

} // namespace listric::dem
