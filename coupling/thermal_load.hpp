#pragma once

#include "coupling/footwall_loads.hpp"
#include "coupling/interface.hpp"
#include "dem/base/sediment_film.hpp"
#include "dem/base/water_level.hpp"
#include "dem/event.hpp"
#include "fem/footwall.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace listric::coupling {

/// Names of what the loads measure; its description declares them.
inline constexpr const char *thermal_load_name = "thermal_load_n_per_m",
                            *film_load_name = "film_load_n_per_m";

/// Weight that columns of rock have by their temperatures now, at knots, Pa: less where it is hot.
using ThermalPressure = std::function<std::vector<double>()>;

/// Places where the load is known, m: 10 km apart over what stretches and 100 km to both sides, as
/// far as the footwall goes; wider apart where these would be more than 60.
/// @param left, right  ends of what stretches
std::vector<double> thermal_knots(double left, double right, double footwall_left,
                                  double footwall_right);

/// Puts the weight that rock has lost by warming since the start on the footwall's lower side, or
/// takes what it has gained by cooling: the column down to the depth where temperature stays floats
/// as one. Its memory has a row per knot: x, at_start and pressure, downward.
class ThermalLoad : public dem::Event {
public:
    /// @param forces  equivalent to the unit loads, by rows, N/Pa
    ThermalLoad(std::vector<double> knots, std::vector<double> forces, ThermalPressure pressure,
                const dem::Schedule& schedule);

    void begin(dem::State& state) override;
    bool start(dem::State& state, const dem::RigidBase& base) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    void take_forces(std::vector<double> forces) { forces_ = std::move(forces); }

    std::vector<double> pressure() const; ///< downward, since the start, at the knots, Pa
    fem::Load load() const;               ///< the pressure as a load
    double weight() const;                ///< N per m of strike

private:
    std::vector<double> knots_, forces_;
    ThermalPressure pressure_;
};

/// By how much the base at x has sunk since the wall last moved, m; 0 while it moves. None: no such
/// load is on the base.
std::optional<double> post_rift_subsidence(const dem::State& state, const dem::Motion& motion,
                                           double x);

/// @param pressure  none: the load stays as it is
FootwallLoad thermal_load(const std::vector<double>& knots, const ThermalPressure& pressure,
                          const dem::Schedule& schedule);

/// Thickness of the film of sediment, m, in columns of that width from the breakaway on: all of it,
/// and what is below a level.
struct FilmColumns {
    std::vector<double> thickness, wet;
    double porosity = 0.0;
};
FilmColumns film_columns(const dem::SedimentFilm& film, const dem::State& state,
                         const dem::RigidBase& base, double level, double column_width);

/// What the film of sediment weighs by.
struct FilmLoadParameters {
    dem::SedimentFilm film;
    double grain_density = 2600.0; ///< kg/m^3
    double gravity = 0.0;          ///< m/s^2
    double column_width = 0.0;     ///< m
    /// Water in whose pressure on the base it lies, so that it weighs less by what it displaces;
    /// none: it weighs as its grains, and other effects count what is in its pores.
    std::optional<dem::WaterLevel> level = {};
    double water_density = 0.0; ///< kg/m^3
};

/// Often enough for what sinks by some metres, and whenever a stratum comes.
dem::Schedule film_schedule(const dem::SedimentFilm& film);

/// Puts the weight of the film on the interface. It has no memory.
class FilmLoad : public dem::Event {
public:
    FilmLoad(const Interface& interface, const FilmLoadParameters& parameters);

    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

private:
    FilmLoadParameters parameters_;
    InterfaceColumns columns_;
};

FootwallLoad film_load(const FilmLoadParameters& parameters);

} // namespace listric::coupling
