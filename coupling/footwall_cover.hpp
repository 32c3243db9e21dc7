#pragma once

#include "dem/event.hpp"

#include <functional>
#include <memory>
#include <span>

namespace listric::coupling {

/// Height that sediment less erosion has brought on the footwall at an x, m, by the events of its
/// loads, to which it refers; empty: none of them brings or takes any.
std::function<double(double x)> footwall_cover(std::span<const std::unique_ptr<dem::Event>> loads);

} // namespace listric::coupling
