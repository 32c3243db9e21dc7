#pragma once

/// The hanging wall on the elastic footwall. Link listric::coupling.

#include "coupling/basin_water.hpp"
#include "coupling/elastic_base.hpp"
#include "coupling/footwall_erosion.hpp"
#include "coupling/footwall_loads.hpp"
#include "coupling/lower_crust_thinning.hpp"
