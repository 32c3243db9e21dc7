#pragma once

#include "apps/measures/base_forces.hpp"
#include "apps/measures/basin/depocentres.hpp"
#include "apps/measures/faults/broken_rock.hpp"
#include "apps/measures/faults/wall_wedge.hpp"
#include "apps/measures/setting.hpp"
#include "apps/measures/strata/cohesion.hpp"
#include "dem/base.hpp"
#include "dem/event.hpp"
#include "dem/state.hpp"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace listric::measures {

/// The acceptance measures (docs/reference/measures.md); those without meaning in a setting are
/// absent.
struct Measures {
    double basin_area = 0.0;             ///< m^2
    std::optional<double> area_balance;  ///< basin area over extension times thickness
    std::optional<dem::Point> cutoff;    ///< x and depth, m
    std::optional<double> rollover_tilt; ///< degrees, positive toward the detachment
    /// Rotations over a ramp-flat-ramp detachment, degrees, positive toward the detachment.
    std::optional<double> breakaway_rotation, toe_rotation, lower_block_rotation;
    std::optional<double> strain_top10, strain_top10_cumulative, strain_gini;
    std::optional<double> basement_unbonded_fraction;
    std::optional<BrokenRock> broken; ///< of the basement
    std::optional<double> old_sediment_bonded_fraction;
    std::optional<std::vector<BondedLayer>> old_sediment_bonded_profile;
    std::optional<double> still_ground; ///< rise of ground that nothing moves, m
    double mass_error_fraction = 0.0;
    std::optional<double> unbalanced_ratio_mean, unbalanced_ratio_max; ///< once forces are sampled
    double inertial_number = 0.0; ///< of the tenth of the area strained most
    /// Whether motion is slow enough not to matter; absent without gravity, where nothing rests,
    /// and before forces are sampled.
    std::optional<bool> quasi_static;
    BaseForces base;
    WallWedge wall_wedge; ///< on a base at rest
    std::optional<std::vector<Depocentre>> depocentres;
    /// Where the halfgraben ends and the collapse graben begins, with the share of the basin's area
    /// on the halfgraben's side.
    std::optional<dem::Point> intervening_high; ///< x and depth, m
    std::optional<double> halfgraben_area_share;
    /// Beside the constructions of kinematics.hpp.
    std::optional<double> dilation_area;         ///< extension times thickness less basin area, m^2
    std::optional<double> depth_to_detachment;   ///< basin area over extension, m
    std::optional<double> inclined_shear_angle;  ///< best fit, degrees from the vertical
    std::optional<double> inclined_shear_misfit; ///< m
    std::optional<double> normals_misfit;        ///< of the head block, m
    std::optional<double> predicted_tilt;        ///< degrees
    std::optional<dem::Point> predicted_cutoff;  ///< x and depth, m
    std::optional<double> predicted_halfgraben_area_share;
};

/// Beyond these a run is not quasi-static: inertia carries part of the load.
inline constexpr double greatest_unbalanced_ratio = 1e-2, greatest_inertial_number = 2e-3;

/// The measures of a state.
/// @param base    as it was at the start, its first surface the detachment
/// @param events  what remembers the run's past
Measures measure(const Setting& setting, const dem::State& state, const dem::RigidBase& base,
                 std::span<const std::unique_ptr<dem::Event>> events);

} // namespace listric::measures
