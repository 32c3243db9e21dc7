#include "apps/measures/paper/hinge.hpp"

#include "apps/measures/faults/fault_trace.hpp"
#include "apps/support/statistics.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

constexpr Quantity hinge_start{
    "hinge_start_x_m", "m", "inner edge of the deforming zone, x",
    "position of the inner edge of the deforming zone: tenth percentile, by strain, of the start x "
    "of discs that started 5 to 10 km deep and are strained by 0.05 per 500 m or more, in the last "
    "window"};
constexpr Quantity hinge_step{"hinge_step_m", "m", "way of the deforming zone's inner edge",
                              "distance that the inner edge of the deforming zone has moved toward "
                              "the breakaway: median of `hinge_start_x_m` over the windows from a "
                              "tenth to four tenths of the extension, less its present value"};

constexpr double shallowest = 5e3, deepest = 10e3;  ///< start of the discs looked at, m of depth
constexpr double nearest_share = 0.1;               ///< of the strain, nearest to the breakaway
constexpr double early_from = 0.1, early_to = 0.42; ///< of the extension

/// How far the deformation has moved into the hanging wall: the tenth percentile, by strain, of the
/// start x of discs that are strained as much as a fault is, m.
std::optional<double> hinge(const RunSoFar& run, const ShearField& field) {
    std::vector<std::pair<double, double>> strained; // start x, strain
    double all = 0.0;
    const double least = FaultTraceOptions{}.least_strain_in(field.window);
    for (std::size_t k = 0; k < field.x.size(); ++k) {
        const std::size_t i = run.row(field, k);
        if (const double depth = -run.discs.start_y[i], shear = field.shear(k);
            run.discs.stratum[i] == 0 && depth > shallowest && depth < deepest && shear >= least) {
            strained.emplace_back(run.discs.start_x[i], shear);
            all += shear;
        }
    }
    std::ranges::sort(strained);
    double sum = 0.0;
    for (const auto& [x, shear] : strained)
        if ((sum += shear) >= nearest_share * all)
            return x;
    return std::nullopt;
}

} // namespace

NamedNumbers measure_hinge(const RunSoFar& run) {
    std::vector<double> early;
    for (std::size_t k = 0; k + 1 < run.past.size(); ++k) {
        const Extension end = run.end_of_window(k).extension;
        if (!run.has_come_to(end, early_from * run.extension) || end > early_to * run.extension)
            continue;
        if (const auto x = hinge(run, run.window(k)))
            early.push_back(*x);
    }
    const auto late = run.past.empty() ? std::nullopt : hinge(run, run.last_window);
    if (early.empty() || !late)
        return {};
    NamedNumbers numbers;
    add(numbers, hinge_start, late);
    add(numbers, hinge_step, median(early) - *late);
    return numbers;
}

std::span<const Quantity> hinge_quantities() {
    static constexpr Quantity all[] = {hinge_start, hinge_step};
    return all;
}

} // namespace listric::measures
