#include "dem/events/old_faults.hpp"

#include "dem/contacts/soft_discs.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <utility>

namespace listric::dem {

namespace {

double distance_from(const std::vector<Point>& line, Point p) {
    double least = 1e300;
    for (std::size_t k = 1; k < line.size(); ++k) {
        const Point from = line[k - 1], along = line[k] - from;
        const double square = dot(along, along);
        const double t = square > 0.0 ? std::clamp(dot(p - from, along) / square, 0.0, 1.0) : 0.0;
        const Point off = p - (from + t * along);
        least = std::min(least, hypotenuse(off.x, off.y));
    }
    return least;
}

} // namespace

std::vector<std::int32_t> discs_on(const State& state, const OldFaultsParameters::Fault& fault) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<std::int32_t> rows;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (weakened(state.materials, d.material[i]) != no_material &&
            distance_from(fault.points, {d.x[i], d.y[i]}) < 0.5 * fault.width)
            rows.push_back(static_cast<std::int32_t>(i));
    return rows;
}

OldFaults::OldFaults(OldFaultsParameters parameters, double gravity)
    : Event("old_faults", never), parameters_(std::move(parameters)), gravity_(gravity) {}

void OldFaults::begin(State& state) { add_enlarged_columns(state); }

bool OldFaults::start(State& state, const RigidBase& base) {
    std::vector<std::int32_t> rows;
    for (const OldFaultsParameters::Fault& fault : parameters_.faults) {
        const std::vector<std::int32_t> of_fault = discs_on(state, fault);
        if (of_fault.empty() && parameters_.on_empty)
            parameters_.on_empty(fault);
        rows.insert(rows.end(), of_fault.begin(), of_fault.end());
    }
    std::ranges::sort(rows);
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    weaken(state, base, rows, parameters_.mean_stress_ratio, gravity_);
    return !rows.empty();
}

} // namespace listric::dem
