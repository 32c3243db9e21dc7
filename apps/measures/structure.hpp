#pragma once

#include "apps/measures/fault.hpp"
#include "apps/measures/measure.hpp"
#include "apps/measures/shear_field.hpp"
#include "apps/support/named_numbers.hpp"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace listric {

/// What a moment's structure needs of an earlier one.
struct Past {
    DiscPlaces places;
    std::vector<Depocentre> basins;         ///< see find_basins
    std::vector<double> throw_correlations; ///< of the faults of the window that ends here
};

/// Local maxima of the pre-rift top's depth with a prominence of 250 m or more, the deepest first.
std::vector<Depocentre> find_basins(const Profile& profile);

/// Structural measures of one moment that need the run's past, its faults, or both.
/// @param past  earlier states, oldest first
NamedNumbers measure_structure(const Scene& scene, const dem::RigidBase& base,
                               const dem::State& now,
                               std::span<const std::unique_ptr<dem::Event>> events,
                               const FaultReport& faults, const Measures& measures,
                               std::span<const Past> past);

/// How far nearer to the breakaway a steep normal fault has come up than those born 2 km of
/// extension before it, m: distance from the nearest of them, at the height of its middle. Steep:
/// 45 degrees. 0: none has.
double inner_fault_step(const std::vector<Fault>& faults);

/// Rank correlation of a fault's throws with the strata's numbers (Spearman), -1 where throw falls
/// from each stratum to the next younger. None for fewer than five strata.
std::optional<double> throw_age_correlation(const std::map<int, double>& throws);

/// The same for every normal fault steeper than 30 degrees that slid between two states.
std::vector<double> throw_age_correlations(const Scene& scene, const dem::RigidBase& base,
                                           const dem::State& now, const DiscPlaces& before);

/// The plane on which a disc's surroundings shear, if they shear on one: of the two planes of
/// largest shear, the one whose simple shear turns the way the displacement field does.
struct ShearPlane {
    double strain = 0.0;     ///< engineering shear strain, > 0
    double dip = 0.0;        ///< degrees
    bool falls_right = true; ///< away from the breakaway
    bool reverse = false;
};
ShearPlane shear_plane(const ShearField& field, std::size_t k);

} // namespace listric
