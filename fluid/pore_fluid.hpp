#pragma once

#include "dem/base/water_level.hpp"
#include "dem/event.hpp"
#include "fluid/pore_cells.hpp"
#include "fluid/pore_law.hpp"
#include "fluid/pore_network.hpp"
#include "fluid/wet_sediment.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace listric::fluid {

/// Water in the pores of sediment and of porous rock: flow through geological time, with the
/// compaction that goes with it, and forces on the discs. Excess pressure u is pressure over that
/// of water at rest, whose part is buoyancy: discs weigh what their grains weigh in water.
struct PoreFluidParameters {
    double interval = 2.5e3;          ///< time between solutions, a
    SedimentFlow flow = {};           ///< of sediment without beds
    double density = 1030.0;          ///< kg/m^3
    double viscosity = 5e-4;          ///< Pa s
    double compressibility = 4.4e-10; ///< 1/Pa
    double rebound = 0.1;             ///< see PoreLaw
    double fracture_ratio = 0.9;      ///< greatest u over the weight of grains in water
    std::optional<double> level = {}; ///< of the water, above the original surface, m
    bool hydrostatic = false;         ///< buoyancy and nothing else
    bool pushes = true;               ///< u exerts forces; else it only keeps pores open
};

/// Where the water ends, and what else it acts on.
struct WaterSurface {
    dem::WaterLevel level = {};
    bool ends = false;       ///< ground above the level is dry (see DryGround), and weighs so
    bool loads_base = false; ///< excess pressure presses on a base that bends
};

/// Share of weight that is left in water.
double buoyant_share(double fluid_density, double grain_density);

/// Law of the pores of a stratum in a field of gravity, m/s^2.
PoreLaw pore_law(const PoreFluidParameters& fluid, const WetSediment& sediment, double gravity,
                 std::int32_t stratum = 0);

/// Solves for the excess pressure and lets it act.
///
/// Total stress is known, as the weight of what lies above and of the stratum that is to come (see
/// WetGround), so pressure and porosity follow from
/// each other without the discs (Terzaghi's consolidation with a moving ground): compaction and the
/// cycles follow. A change of the discs' volumes is not handed back: packing noise would become
/// pressure, and sediment is so soft against water that the iteration would not be stable.
///
/// Columns of discs: excess_pressure, Pa; pore_water, m^2 (-1: not counted yet); burial, m,
/// greatest equivalent depth; start_grains, m, where rock is porous; wanted_porosity, which
/// compaction follows; overpressure_ratio, u over the weight of grains in water; darcy_x, darcy_y,
/// m/s, volume of water that passes an area in a time; push_x, push_y; and, where the base is
/// loaded, those of add_base_pressure(). Its memory has one row: see Sums.
class PoreFluid : public dem::Event {
public:
    /// @param gravity  of planet, not of discs in water, m/s^2
    PoreFluid(const PoreFluidParameters& fluid, const WetSediment& sediment, double gravity,
              const dem::Calendar& calendar, const WaterSurface& surface = {});

    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    /// Names of what is remembered: water, m^2, that came with sediment or was in porous rock, left
    /// through the ground, was vented and eroded, and that is left; the greatest number of Newton's
    /// steps so far; and of the last solution shares of wet discs whose lift was cut, of those that
    /// no flow reaches, and the mud's own volumes over those of its cells; where the base is
    /// loaded, what was missing to balance the pressure on it.
    struct Sums {
        static constexpr const char *came = "came", *surface = "surface", *vented = "vented",
                                    *eroded = "eroded", *left = "left", *newton = "newton_steps",
                                    *capped = "lift_capped", *enclosed = "enclosed", *fill = "fill",
                                    *closure = "closure";
    };
    double remembered(std::string_view name) const { return memory.get<double>(name)[0]; }
    bool loads_base() const { return surface_.loads_base; }

    const PoreFluidParameters& parameters() const { return fluid_; }
    const WetSediment& sediment() const { return sediment_; }
    double grain_weight() const { return laws_.front().grain_weight; } ///< as PoreLaw has it
    const PoreLaw& law(std::int32_t stratum) const { return laws_[bed_of(stratum)]; }
    const SedimentFlow& flow_of(std::int32_t stratum) const { return flows_[bed_of(stratum)]; }
    double fluid_weight() const { return fluid_weight_; } ///< N/m^3

private:
    struct Mud;

    std::size_t bed_of(std::int32_t stratum) const { return sediment_.beds.of(stratum); }
    void take_stock(dem::State& state, const PoreCells& cells);
    Mud mud_of(const dem::State& state, const WetGround& ground, const PoreCells& cells) const;
    VoidRatio pores(const Mud& mud, std::size_t cell, double excess_pressure) const;
    void cover(const dem::State& state, std::int32_t next_stratum, PoreCells& cells) const;
    double pending_load(const PoreCells& cells, std::size_t cell) const;
    double grains_of(const WetGround& ground, dem::Point p, double of_discs, double level) const;
    void push(dem::State& state, const dem::RigidBase& base, const PoreCells& cells);

    PoreFluidParameters fluid_;
    WetSediment sediment_;
    WaterSurface surface_;
    std::vector<PoreLaw> laws_;       ///< by bed
    std::vector<SedimentFlow> flows_; ///< likewise
    double fluid_weight_;             ///< N/m^3
};

} // namespace listric::fluid
