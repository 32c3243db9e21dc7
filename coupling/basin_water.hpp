#pragma once

#include "coupling/footwall_loads.hpp"
#include "coupling/interface.hpp"
#include "dem/event.hpp"

#include <vector>

namespace listric::coupling {

/// Water fills what lies below its level above hanging wall and detachment. Its weight goes
/// straight down to the detachment. It does not act on the discs: their contacts carry effective
/// stress, which water whose pressure is in the pores, too, leaves as it is. Its pushes sideways,
/// on the scarp and on the head block, balance each other and are left out.
struct BasinWaterParameters {
    double level = 0.0;       ///< of its surface, above the original surface, m
    double density = 1030.0;  ///< kg/m^3
    double interval = 2500.0; ///< time between adaptations, a
};

/// Two mean disc diameters, m: the highest disc of a column is then the surface.
inline double water_column_width(double mean_radius) { return 4.0 * mean_radius; }

/// Depth of the water, m, in columns of that width from the breakaway on. The floor of a column is
/// its highest disc, or the detachment where no disc lies.
std::vector<double> water_depths(const dem::State& state, double level, double column_width);

/// Weight of the water on the footwall, N per m of strike.
double water_weight(const dem::State& state);

/// Puts the weight of the water on the interface.
///
/// Its memory has a row: start_depth_m, the mean depth between the tops of the discs of the
/// original surface and the level. That is the surface's roughness, and no water.
class BasinWater : public dem::Event {
public:
    BasinWater(const Interface& interface, const BasinWaterParameters& parameters, double gravity,
               double column_width, double extension_rate);

    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

private:
    BasinWaterParameters parameters_;
    double gravity_, column_width_;
    std::size_t nodes_;
    std::vector<std::vector<double>> per_pascal_; ///< by column: forces on the nodes, upward, N
};

FootwallLoad basin_water_load(const BasinWaterParameters& parameters, double gravity,
                              double column_width, double extension_rate);

} // namespace listric::coupling
