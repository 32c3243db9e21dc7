#pragma once

#include "apps/scene.hpp"
#include "dem/base.hpp"
#include "dem/event.hpp"
#include "dem/state.hpp"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace listric {

/// Local maximum of the sediment thickness, smoothed over 1 km.
struct Depocentre {
    double x = 0.0, thickness = 0.0, prominence = 0.0; ///< m
};

/// Surfaces along x, in columns one mean disc diameter wide.
struct Profile {
    std::vector<double> x;                  ///< middle of the column, m
    std::vector<double> pre_rift_top;       ///< m, y up; the detachment where it is exposed
    std::vector<double> sediment_thickness; ///< m, smoothed over 1 km
};

/// The acceptance measures (docs/measures.md); those without meaning in a scene are absent.
struct Measures {
    double basin_area = 0.0;             ///< m^2
    std::optional<double> area_balance;  ///< basin area over extension times thickness
    std::optional<Point> cutoff;         ///< x and depth, m
    std::optional<double> rollover_tilt; ///< degrees, positive toward the detachment
    std::optional<double> strain_top10, strain_top10_cumulative, strain_gini;
    std::optional<double> basement_unbonded_fraction;
    std::optional<double> weak_fraction; ///< of discs
    std::optional<double> volume_error_fraction;
    double mass_error_fraction = 0.0;
    double unbalanced_ratio_mean = 0.0, unbalanced_ratio_max = 0.0;
    double inertial_number = 0.0; ///< of the tenth of the area strained most
    std::optional<std::vector<Depocentre>> depocentres;
};

Profile measure_profile(const Scene& scene, const State& state, const RigidBase& base);

Measures measure(const Scene& scene, const State& state, const RigidBase& base,
                 std::span<const std::unique_ptr<Event>> events);

/// Share of `amount` held by the given share of `area` where it is densest.
double share_of_densest(std::span<const double> density, std::span<const double> area,
                        double area_share);

/// Gini coefficient of a density over area: 0 uniform, 1 all in one place.
double gini(std::span<const double> density, std::span<const double> area);

/// Local maxima with at least the given prominence, the thickest first.
std::vector<Depocentre> find_depocentres(std::span<const double> x,
                                         std::span<const double> thickness,
                                         double least_prominence);

} // namespace listric
