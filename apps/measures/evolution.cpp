#include "apps/measures/evolution.hpp"

#include "apps/measures/basin/dilation.hpp"
#include "apps/measures/faults/main_faults.hpp"
#include "apps/measures/paper/block_edges.hpp"
#include "apps/measures/paper/blocks.hpp"
#include "apps/measures/paper/folds.hpp"
#include "apps/measures/paper/grabens.hpp"
#include "apps/measures/strata/rock.hpp"
#include "dem/base/just_before.hpp"

namespace listric::measures {

using namespace dem;

Past remember(const Setting& setting, const RigidBase& base, const State& now,
              std::span<const Past> past) {
    Past moment{DiscPlaces(now), find_basins(measure_profile(setting, now, base))};
    if (past.empty())
        moment.rock = rock_packing(now, base);
    return moment;
}

NamedNumbers measure_evolution(const Setting& setting, const RigidBase& base, const State& now,
                               const FaultReport& faults, const Measures& measures,
                               std::span<const DetectedSegment> segments,
                               std::span<const Past> past) {
    const RunSoFar run(setting, base, now, past);
    NamedNumbers numbers = measure_main_faults(run, faults, measures.rollover_tilt);
    // The rest compares moments of a wall that is pulled on and on.
    if (base.motion.shortens(just_before(base.motion, now.clock))) {
        append(numbers, measure_dilation(run));
        return numbers;
    }
    append(numbers, measure_block_edges(run, measures.rollover_tilt));
    append(numbers, measure_persistence(run));
    append(numbers, measure_relief(run));
    append(numbers, measure_rock(setting, now));
    append(numbers, measure_grabens(run));
    append(numbers, measure_hinge(run));
    append(numbers, measure_dilation(run));
    if (const auto parts = find_ramp_flat_ramp(run.detachment); parts && !past.empty()) {
        append(numbers, measure_kink(run, *parts, faults.faults, segments));
        append(numbers, measure_syncline(run, *parts));
        append(numbers, measure_lower_block(run, *parts, faults.faults));
    }
    return numbers;
}

std::vector<Quantity> evolution_quantities() {
    std::vector<Quantity> all = main_fault_quantities();
    const std::vector<Quantity> edges = block_edge_quantities();
    all.insert(all.end(), edges.begin(), edges.end());
    for (const std::span<const Quantity> some :
         {persistence_quantities(), relief_quantities(), rock_quantities(), graben_quantities(),
          hinge_quantities(), dilation_quantities(), kink_quantities(), syncline_quantities(),
          lower_block_quantities()})
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

} // namespace listric::measures
