#include "thermal/expansion.hpp"

#include <cassert>

namespace listric::thermal {

using namespace dem;

std::vector<double> mass_lost(const Heat& heat, const State& state, const RigidBase& base,
                              std::span<const double> knots) {
    assert(knots.size() > 1);
    const HeatCells all = heat.cells(state);
    const SectionEnds ends = section_ends(heat.parameters(), heat.setting());
    const GroundLine ground = ground_line(state, base, heat.setting().beside);
    std::vector<double> sums(knots.size(), 0.0);
    for (const CellPart& part : cell_parts(all.sites, ends, ground, knots)) {
        const std::size_t i = part.cell, k = part.strip;
        const double warmer =
            all.temperature[i] - heat.start_temperature({all.sites.x[i], all.sites.y[i]});
        const double mass = heat.parameters().expansion * all.density[i] * warmer * part.area;
        const double right = (part.x - knots[k]) / (knots[k + 1] - knots[k]);
        sums[k] += (1.0 - right) * mass;
        sums[k + 1] += right * mass;
    }
    for (std::size_t k = 0; k < sums.size(); ++k)
        sums[k] /= 0.5 * (knots[std::min(k + 1, knots.size() - 1)] - knots[k > 0 ? k - 1 : 0]);
    return sums;
}

} // namespace listric::thermal
