#pragma once

#include "coupling/footwall_erosion.hpp"
#include "coupling/footwall_loads.hpp"
#include "coupling/interface.hpp"
#include "coupling/thermal_load.hpp"
#include "dem/base/sediment_film.hpp"
#include "dem/event.hpp"

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace listric::coupling {

/// Names of what the load measures; its description declares them.
inline constexpr const char *basin_water_name = "basin_water_n_per_m",
                            *pore_water_name = "pore_water_n_per_m",
                            *flank_water_name = "flank_water_n_per_m";

/// Water fills what lies below its level above hanging wall and detachment, the pores of the
/// sediment there and, left of the breakaway, what of the footwall's surface has sunk below it. Its
/// weight in the basin goes straight down to the detachment. It does not act on the discs: their
/// contacts carry effective stress, which water whose pressure is in the pores, too, leaves as it
/// is, and their masses are those of grains. Its pushes sideways, on the scarp and on the head
/// block, are left out, one because the other is: only the discs could hand it on.
struct BasinWaterParameters {
    double level = 0.0;       ///< of its surface, above the original surface, m
    double density = 1030.0;  ///< kg/m^3
    double interval = 2500.0; ///< time between adaptations, a
    bool flank_alone = false; ///< something else puts the rest on the base
    /// Sediment that no disc stands for, which lies in the water: that is above it and in its
    /// pores. None: there is no such.
    std::optional<dem::SedimentFilm> film = {};
};

/// Depth of the water, m, in columns of that width from the breakaway on. The floor of a column is
/// its highest disc, or the detachment where no disc lies.
std::vector<double> water_depths(const dem::State& state, double level, double column_width);

/// The pores of sediment.
struct PoreSpace {
    double grain_density = 2600.0; ///< kg/m^3
    double porosity = 0.5;         ///< without compaction, whose discs have their own
};

/// Water in the pores of sediment below the level, m^2, in the same columns. The pores belong to
/// the discs' mass m of grains of density rho, m / rho Phi / (1 - Phi): the saturated bulk density
/// is (1 - Phi) rho and that of water times Phi.
std::vector<double> pore_water(const dem::State& state, double level, const PoreSpace& pores,
                               double column_width);

/// Weight of the water on the detachment, N per m of strike: all of it, and that in the pores.
double water_weight(const dem::State& state);
double pore_water_weight(const dem::State& state);

/// The footwall's surface left of the breakaway, where it may sink below the level.
struct Flank {
    SurfaceResponse response;
    std::vector<double> forces; ///< equivalent to the response's interface displacements, N/Pa
    /// Height of the response's knots without the weight of this water, m.
    std::function<std::vector<double>(const dem::State&)> height;
};

/// Changes of the water's depth on the flank since the start, at the knots, m: with what it adds to
/// its own depth by its weight.
/// @param dry     heights without this water, m
/// @param weight  of water, N/m^3
std::vector<double> flank_depths(const SurfaceResponse& response, std::span<const double> dry,
                                 double level, double weight);

/// Puts the weight of the water on the interface and on the flank.
///
/// Its memory has a row per knot of the flank, one without: start_depth_m, in each row the mean
/// depth between the tops of the discs of the original surface and the level, which is the
/// surface's roughness and no water, and flank_depth_m.
class BasinWater : public dem::Event {
public:
    BasinWater(const Interface& interface, const BasinWaterParameters& parameters, double gravity,
               double column_width, const dem::Calendar& calendar,
               const std::optional<PoreSpace>& pores = {}, std::optional<Flank> flank = {});

    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    void take_flank(Flank flank) { flank_ = std::move(flank); } ///< of the same knots

    std::vector<double> flank_pressure() const; ///< downward, at the flank's knots, Pa
    fem::Load flank_load() const;               ///< the pressure as a load
    double flank_weight() const;                ///< N per m of strike

private:
    void fill_basin(dem::State& state, const dem::RigidBase& base) const;

    BasinWaterParameters parameters_;
    std::optional<PoreSpace> pores_;
    std::optional<Flank> flank_;
    double gravity_;
    InterfaceColumns columns_;
};

/// @param pores       of the sediment, if there is any
/// @param flank_left  side of the footwall whose flank takes water, m; none: the flank stays dry
FootwallLoad basin_water_load(const BasinWaterParameters& parameters, double gravity,
                              double column_width, const dem::Calendar& calendar,
                              const std::optional<PoreSpace>& pores,
                              std::optional<double> flank_left);

} // namespace listric::coupling
