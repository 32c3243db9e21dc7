#pragma once

#include "coupling/footwall_loads.hpp"
#include "dem/event.hpp"
#include "fem/footwall.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace listric::coupling {

/// Names of what the load measures; its description declares them.
inline constexpr const char* thermal_load_name = "thermal_load_n_per_m";

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

} // namespace listric::coupling
