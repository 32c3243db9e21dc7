#pragma once

#include "apps/scene/scene.hpp"
#include "dem/base.hpp"
#include "dem/event.hpp"
#include "dem/events/energy_account.hpp"
#include "dem/state.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string_view>
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
    std::optional<dem::Point> cutoff;    ///< x and depth, m
    std::optional<double> rollover_tilt; ///< degrees, positive toward the detachment
    /// Rotations over a ramp-flat-ramp detachment, degrees, positive toward the detachment.
    std::optional<double> breakaway_rotation, toe_rotation, lower_block_rotation;
    std::optional<double> strain_top10, strain_top10_cumulative, strain_gini;
    std::optional<double> basement_unbonded_fraction;
    std::optional<double> weak_fraction; ///< of discs
    std::optional<double> volume_error_fraction;
    std::optional<double> deposited_fraction, eroded_fraction; ///< of mass, over the initial
    double mass_error_fraction = 0.0;
    double unbalanced_ratio_mean = 0.0, unbalanced_ratio_max = 0.0;
    double inertial_number = 0.0; ///< of the tenth of the area strained most
    /// Whether motion is slow enough not to matter; absent without gravity, where nothing rests.
    std::optional<bool> quasi_static;
    std::optional<dem::EnergyBalance> energy;
    std::optional<std::vector<Depocentre>> depocentres;
    /// Where the halfgraben ends and the collapse graben begins, with the share of the basin's area
    /// on the halfgraben's side.
    std::optional<dem::Point> intervening_high; ///< x and depth, m
    std::optional<double> halfgraben_area_share;
    /// Beside the constructions of apps/kinematics.hpp.
    std::optional<double> dilation_area;         ///< extension times thickness less basin area, m^2
    std::optional<double> depth_to_detachment;   ///< basin area over extension, m
    std::optional<double> inclined_shear_angle;  ///< best fit, degrees from the vertical
    std::optional<double> inclined_shear_misfit; ///< m
    std::optional<double> normals_misfit;        ///< of the head block, m
    std::optional<double> predicted_tilt;        ///< degrees
    std::optional<dem::Point> predicted_cutoff;  ///< x and depth, m
    std::optional<double> predicted_halfgraben_area_share;
    std::optional<double> old_sediment_bonded_fraction;
};

/// Beyond these a run is not quasi-static: inertia carries part of the load.
inline constexpr double greatest_unbalanced_ratio = 1e-2, greatest_inertial_number = 2e-3;

/// Where a detachment that descends to a flat and then further has its parts, m along the chain.
struct RampFlatRamp {
    double flat_start = 0.0;  ///< the upper ramp soles out
    double flat_end = 0.0;    ///< the kink begins
    double lower_start = 0.0; ///< the kink ends
    double flat_depth = 0.0;  ///< m
};

/// The event of that name; null: the scene has none.
const dem::Event* find_event(std::span<const std::unique_ptr<dem::Event>> events,
                             std::string_view name);

/// None for a detachment that soles out once.
std::optional<RampFlatRamp> find_ramp_flat_ramp(const dem::Chain& detachment);

Profile measure_profile(const Scene& scene, const dem::State& state, const dem::RigidBase& base);

/// Depth of the pre-rift top below the original surface, smoothed over 1 km, by column, m.
std::vector<double> smoothed_depth(const Profile& profile);

/// Where the basin is shallowest between its first depocentre and the most prominent one beyond;
/// none if there is no second. `depth` in equal columns, m.
std::optional<std::size_t> find_intervening_high(std::span<const double> x,
                                                 std::span<const double> depth,
                                                 double least_prominence);

/// Bonded share of the touching pairs of sediment discs that are both deeper than `depth` m below
/// the level and older than `age` m of extension. None if there are no such pairs.
std::optional<double> bonded_share_of_old_sediment(const dem::State& state, double level,
                                                   double depth, double age);

/// Rows of the pre-rift discs of a ramp-flat-ramp hanging wall that started below the flat's level,
/// on the lower ramp and within half its height.
std::vector<std::size_t> lower_block(const dem::State& state, const dem::Chain& detachment,
                                     const RampFlatRamp& parts);

Measures measure(const Scene& scene, const dem::State& state, const dem::RigidBase& base,
                 std::span<const std::unique_ptr<dem::Event>> events);

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
