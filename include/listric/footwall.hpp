#pragma once

/// The elastic footwall, as numbers at the nodes of its detachment. Link listric::footwall; the
/// finite elements are a plug-in that is loaded when a footwall is made.

#include "fem/footwall.hpp"
#include "fem/plate.hpp"
