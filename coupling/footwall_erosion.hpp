#pragma once

#include "coupling/footwall_loads.hpp"
#include "dem/base/target_line.hpp"
#include "dem/event.hpp"
#include "fem/footwall.hpp"

#include <functional>
#include <span>
#include <vector>

namespace listric::coupling {

/// Names of what the load measures; its description declares them.
inline constexpr const char *footwall_eroded_name = "footwall_eroded_m2",
                            *footwall_deposited_name = "footwall_deposited_m2";

/// Erosion and deposition on the footwall, left of the breakaway, to a target line.
struct FootwallErosionParameters {
    double interval = 5.0e4;                   ///< between adaptations, a
    double level = 0.0;                        ///< of the target, above the original surface, m
    std::vector<dem::TargetStage> target = {}; ///< the target line; empty: the level
    double width = 100e3;                      ///< of the footwall that is worked on, m
    double sediment_density = 2300.0;          ///< of what is laid down, kg/m^3
    double rock_density = 2700.0;              ///< of what is eroded first, kg/m^3
};

/// How the footwall's surface answers, at knots from the left to the breakaway. A pressure is
/// linear between knots, a height at a knot is the mean weighted with that pressure, so that one is
/// the other's transpose.
struct SurfaceResponse {
    std::vector<double> x;         ///< of m knots, m
    std::vector<double> width;     ///< that a knot stands for, m
    std::vector<double> interface; ///< displacement for 1 Pa downward: m rows of 2 n, m/Pa
    std::vector<double> uplift;    ///< at the column's knot for 1 Pa at the row's: m by m, m/Pa

    /// From the solution for surface_loads(knots).
    /// @param interface  displacement: m rows of 2 n, m/Pa
    /// @param sums       of the loads, N/m
    /// @param work       of these loads on each other's displacement: m by m, J/m
    SurfaceResponse(std::vector<double> knots, std::vector<double> interface,
                    std::span<const fem::Vector> sums, std::span<const double> work);

    /// Uplift of the knots by loads, from their work on the displacement by the surface's loads, a
    /// row per load, J/m; in m. (A pressure's work over its width is the mean of the boundary's
    /// sinking there.)
    std::vector<double> uplift_by_work(std::span<const double> work) const;

    /// Uplift of the knots by forces on the interface's unknowns, N. (Betti)
    std::vector<double> uplift_by(std::span<const double> forces) const;
};

/// Uplift of the surface's knots by discs, by what rests on the interface and by the other effects'
/// loads, m. Refers to the solution's base.
std::function<std::vector<double>(const dem::State&)> surface_uplift(const SurfaceResponse& surface,
                                                                     const LoadSolution& solution);

/// Knots every 2 km at the breakaway and by a quarter of the distance further away, over `width` m
/// and not beyond the footwall's left side.
std::vector<double> surface_knots(double width, double left);

/// A pressure of 1 Pa downward at each knot.
std::vector<fem::Load> surface_loads(const std::vector<double>& knots);

/// Pressures at the knots, linear in between, downward, Pa.
fem::Load surface_load(std::vector<double> knots, std::vector<double> pressure);

/// Rock that is gone and sediment that has come, by knot, m.
struct FootwallCover {
    std::span<double> eroded, deposited;
};
struct ConstFootwallCover {
    std::span<const double> eroded, deposited;

    ConstFootwallCover(std::span<const double> rock, std::span<const double> sediment)
        : eroded(rock), deposited(sediment) {}
    ConstFootwallCover(const FootwallCover& c) : eroded(c.eroded), deposited(c.deposited) {}
};

/// Brings the surface to the target line, with the rebound that this causes: sediment goes before
/// rock, and hollows are filled. Returns how often rebound was followed up.
/// @param uplift  of the knots by everything but the cover, m
/// @param target  heights of the line at the knots, m
int adapt_footwall(const SurfaceResponse& response, const FootwallErosionParameters& parameters,
                   double gravity, std::span<const double> uplift, std::span<const double> target,
                   const FootwallCover& cover);

/// Pressure of the cover on the knots relative to the start, downward, Pa.
std::vector<double> cover_pressure(const FootwallErosionParameters& parameters, double gravity,
                                   const ConstFootwallCover& cover);

/// Adapts the footwall's surface and puts the change of weight on it. Its memory has a row per
/// knot: x, eroded, deposited.
class FootwallErosion : public dem::Event {
public:
    /// Uplift of the knots by everything but the cover, m.
    using Uplift = std::function<std::vector<double>(const dem::State& state)>;

    /// @param forces  equivalent to the response's interface displacements, by rows, N/Pa
    FootwallErosion(SurfaceResponse response, std::vector<double> forces, Uplift uplift,
                    const FootwallErosionParameters& parameters, double gravity,
                    const dem::Calendar& calendar);

    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    /// Takes another response of the same knots.
    void take_response(SurfaceResponse response, std::vector<double> forces, Uplift uplift);

    std::vector<double> pressure() const; ///< of the cover as it is, on the knots, Pa
    fem::Load load() const;               ///< the pressure as a load

    struct Areas {
        double eroded, deposited; ///< m^2
    };
    Areas areas() const;
    double cover(double x) const;    ///< height that sediment less erosion has brought, m
    double sediment(double x) const; ///< thickness of the sediment, m

private:
    double at(double x, std::span<const double> by_knot) const;

    SurfaceResponse response_;
    std::vector<double> forces_;
    Uplift uplift_;
    FootwallErosionParameters parameters_;
    dem::Target target_;
    double gravity_;
};

/// @param left  side of the footwall, m
FootwallLoad footwall_erosion_load(const FootwallErosionParameters& parameters, double gravity,
                                   double left, const dem::Calendar& calendar);

} // namespace listric::coupling
