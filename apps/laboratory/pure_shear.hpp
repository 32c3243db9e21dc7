#pragma once

#include "apps/measures/faults/fault_trace.hpp"
#include "apps/run/run.hpp"
#include "apps/scene/scene.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// Critical rates of AFD and ICM, 1/s [paper, Table 1].
struct CriticalRates {
    double weakening = 1e-13, healing = 1e-15;
    bool operator==(const CriticalRates&) const = default;
};

/// The rates as changes of a scene, "table.key=value".
std::vector<std::string> assignments(const CriticalRates& rates);

/// The rates of a scene that has both effects.
CriticalRates critical_rates(const Scene& scene);

/// A fault of the stretched slab.
struct SlabFault {
    double dip_at_birth = 0.0, length = 0.0; ///< degrees, m
    bool falls_right = true;
    double born_at = 0.0; ///< extension at the end of the window in which it was first traced, m
};

/// Measures of a stretched slab (docs/reference/measures.md).
struct StretchedSlab {
    std::vector<SlabFault> faults;    ///< normal ones, each as it was when first traced
    std::vector<double> segment_dips; ///< of what AFD's measure circle found, degrees
    double strain_top10 = 0.0, strain_top10_cumulative = 0.0;
    double weak_fraction = 0.0;
    double unbalanced_ratio = 0.0;
    double healed_share = 0.0; ///< see healed_share()

    /// Faults dip to both sides.
    bool conjugate() const;
};

/// Share of the pairs of bondable discs that touch in `end` and did not in `start`, which is
/// bonded. Only healing can have bonded them. None without such pairs.
std::optional<double> healed_share(const dem::State& start, const dem::State& end);

/// Normal faults between the states of a run, oldest first, each as it was when first traced: the
/// ridges of shear strain between two states that follow no trace of the states before. A ridge
/// needs less contrast here than beside a detachment, since other shear zones are all around.
std::vector<SlabFault> trace_births(const std::vector<measures::DiscPlaces>& states,
                                    const dem::Chain& base);

/// Runs the scene, or goes on with the run in the options' folder, and measures.
/// Throws what run_scene throws, and Interrupted: the same call goes on from there.
StretchedSlab stretch_slab(const Scene& scene, RunOptions options);

/// Mean dip at birth, degrees, weighted by length; none without faults.
std::optional<double> mean_dip(const std::vector<SlabFault>& faults);

/// Dip, degrees, that Anderson's theory predicts for an angle of internal friction given as its
/// tangent: 45 + phi / 2.
double anderson_dip(double friction);

} // namespace listric
