#include "dem/event.hpp"

#include "dem/units.hpp"

namespace listric::dem {

double Schedule::seconds() const { return interval * seconds_per_year; }

} // namespace listric::dem
