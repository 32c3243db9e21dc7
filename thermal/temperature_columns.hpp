#pragma once

#include "thermal/heat.hpp"

#include <optional>
#include <vector>

namespace listric::thermal {

/// Places where columns of discs and points come to a temperature.
class TemperatureColumns {
public:
    TemperatureColumns(const Heat& heat, const dem::State& state, const dem::RigidBase& base)
        : cells_(heat.cells(state)), ground_(heat.solved_ground(state, base)),
          surface_(heat.parameters().surface_temperature) {}

    /// The uppermost. None: not above the section's floor.
    std::optional<dem::Point> crossing(double x, double temperature) const;

    double depth(dem::Point p) const { return ground_.depth(p); }

private:
    std::vector<std::size_t> sites_about(double x) const;

    HeatCells cells_;
    GroundLine ground_;
    double surface_;
};

/// A line through the places where columns come to a temperature, as rock lay before the base
/// moved, m: where no column does, at the section's floor.
std::vector<dem::Point> isotherm(const Heat& heat, const dem::State& state,
                                 const dem::RigidBase& base, double temperature,
                                 std::span<const double> x);

} // namespace listric::thermal
