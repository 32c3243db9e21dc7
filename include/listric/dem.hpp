#pragma once

/// The hanging wall: discs, cycle and events, on a base that is rigid or moves as prescribed. Link
/// listric::dem; begin with dem/model.hpp.

#include "dem/events/energy_account.hpp"
#include "dem/events/equilibrium.hpp"
#include "dem/events/property_update.hpp"
#include "dem/events/sediment_stress.hpp"
#include "dem/events/strain.hpp"
#include "dem/model.hpp"
