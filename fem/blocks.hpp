#pragma once

#include "fem/block_mesh.hpp"

namespace listric::fem {

/// The detachment extended to the right side. Throws FootwallError if it leaves the mesh.
Curve extended_detachment(const FootwallRequest& request);

/// Blocks between the detachment and the base. Where the detachment is steeper than 45 degrees,
/// rows of cells end at it; where it is flatter, columns do; a strip of cells lies along it.
/// Without a detachment, blocks of a flat layer. Throws FootwallError.
BlockMesh make_blocks(const FootwallRequest& request);

} // namespace listric::fem
