#pragma once

/// The hanging wall: discs, cycle and events, on a base that is rigid or moves as prescribed. Link
/// listric::dem; dem/simulation.hpp says how to begin.

#include "dem/events/bond_healing.hpp"
#include "dem/events/compaction.hpp"
#include "dem/events/energy_account.hpp"
#include "dem/events/equilibrium.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/property_update.hpp"
#include "dem/events/sediment_stress.hpp"
#include "dem/events/sedimentation.hpp"
#include "dem/events/strain.hpp"
#include "dem/genesis/detachment.hpp"
#include "dem/genesis/genesis.hpp"
#include "dem/simulation.hpp"
