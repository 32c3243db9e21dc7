#pragma once

#include "coupling/footwall_loads.hpp"
#include "coupling/interface.hpp"
#include "dem/base/water_level.hpp"
#include "dem/calendar.hpp"
#include "dem/event.hpp"

#include <span>
#include <vector>

namespace listric::coupling {

/// Names of what the load measures; its description declares them.
inline constexpr const char *water_load_name = "water_load_n_per_m",
                            *water_force_error_name = "water_force_error";

/// Water in the pores of all discs, which weigh what they weigh in water: the base then bears the
/// water's pressure beside them.
struct WaterLoadParameters {
    dem::WaterLevel level = {};
    double density = 1030.0;       ///< of water, kg/m^3
    double grain_density = 2600.0; ///< of discs, kg/m^3
    double gravity = 9.81;         ///< of the planet, m/s^2
    double interval = 2500.0;      ///< between updates, a
    /// x of the right wall before extension, m. Beyond the wall there are no discs: rock takes its
    /// water along, and its weight on the base stays.
    double wall_x = 0.0;

    double weight() const { return density * gravity; }                   ///< N/m^3
    double buoyancy() const { return density / grain_density * gravity; } ///< of discs, N/kg
};

/// The line through the nodes as it is displaced.
struct DeformedTrace {
    std::span<const double> x, y, ux, uy; ///< nodes, and displacements; these empty: at rest
    int degree = 2;
};

/// Forces of water at rest on the nodes, N: pressure times normal along the deformed trace, up to
/// a place before deformation, m. Exact. They follow from an energy, weight / 2 times the integral
/// of the depth's square over x, but for the trace's end: their change with the displacements is
/// symmetric.
std::vector<double> water_forces(const DeformedTrace& trace, double level, double weight,
                                 double to_x);

/// Area between the level and the part of that trace below it, m^2.
double water_area(const DeformedTrace& trace, double level, double to_x);

/// Puts pressure of water at rest, and excess pressure where something gives it, on the interface,
/// less that of the settled start. Its memory has one row: water_load_n_per_m, weight beyond that
/// at the start, and water_force_error.
class WaterLoad : public dem::Event {
public:
    WaterLoad(const Interface& interface, const WaterLoadParameters& parameters,
              const dem::Calendar& calendar);

    /// Before the discs settle on the base: those above the level weigh so.
    void prepare(dem::State& state) const;

    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    NamedValues measures() const;

private:
    double excess_forces(dem::State& state, std::span<double> forces) const;
    double force_error(const dem::State& state, double level, const DeformedTrace& trace,
                       double to_x, double on_base) const;

    WaterLoadParameters parameters_;
    std::vector<double> x_, y_;
    int degree_;
};

FootwallLoad water_load(const WaterLoadParameters& parameters, const dem::Calendar& calendar);

} // namespace listric::coupling
