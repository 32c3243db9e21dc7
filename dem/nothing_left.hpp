#pragma once

#include "dem/cycle_physics.hpp"

namespace listric::dem {

/// An event would leave no disc: no other time step helps.
struct NothingLeft : NumericalFailure {
    using NumericalFailure::NumericalFailure;
};

} // namespace listric::dem
