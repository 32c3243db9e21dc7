#include "apps/measures/faults/localisation.hpp"

#include "dem/columns.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

constexpr double densest = 0.1; ///< share of the area

/// Strain of the pre-rift discs with what weighs it.
struct BasementStrain {
    std::vector<double> last, sum; ///< of the last window, since the start
    std::vector<double> area;      ///< m^2
    std::vector<double> inertial;  ///< inertial numbers; empty without gravity
};

/// @param rate  strain rate in the model over strain of the window, 1/s
BasementStrain basement_strain(const State& state, std::span<const double> window,
                               std::span<const double> total, double rate, double gravity) {
    const ConstDiscColumns d = disc_columns(state);
    BasementStrain strain;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] != 0)
            continue;
        strain.last.push_back(window[i]);
        strain.sum.push_back(total[i]);
        strain.area.push_back(pi * d.radius[i] * d.radius[i]);
        // I = strain rate * diameter * sqrt(density / pressure).
        const double depth = std::max(2.0 * state.mean_radius, -d.y[i]);
        if (gravity > 0.0)
            strain.inertial.push_back(window[i] * rate * 2.0 * d.radius[i] /
                                      std::sqrt(gravity * depth));
    }
    return strain;
}

/// Mean over the given share of the area where the density is largest.
double mean_of_densest(const std::vector<double>& density, const std::vector<double>& area) {
    if (density.empty())
        return 0.0;
    const double mean = std::inner_product(density.begin(), density.end(), area.begin(), 0.0) /
                        std::accumulate(area.begin(), area.end(), 0.0);
    return 10.0 * mean * share_of_densest(density, area, densest);
}

/// Time in the model of the last whole window, or of what there is of the first, s.
double seconds_of_window(const Setting& setting, const State& state, const Strain& strain) {
    const double spacing = strain.schedule().spacing();
    const Travel end = strain.applied > 0 ? Travel(static_cast<double>(strain.applied) * spacing)
                                          : state.clock.travel;
    const Travel start = strain.applied > 0 ? end - Travel(spacing) : Travel();
    if (setting.motion.stages.empty()) // at full speed
        return (end - start).m / setting.extension_speed;
    return setting.motion.time_at(end) - setting.motion.time_at(start);
}

} // namespace

double share_of_densest(std::span<const double> density, std::span<const double> area,
                        double area_share) {
    assert(density.size() == area.size());
    std::vector<std::size_t> order(density.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return density[a] > density[b]; });
    double total = 0.0;
    for (std::size_t k : order)
        total += density[k] * area[k];
    const double wanted = area_share * std::accumulate(area.begin(), area.end(), 0.0);
    double taken = 0.0, held = 0.0;
    for (std::size_t k : order) {
        const double part = std::min(area[k], wanted - taken);
        if (part <= 0.0)
            break;
        taken += part;
        held += density[k] * part;
    }
    return total > 0.0 ? held / total : 0.0;
}

double gini(std::span<const double> density, std::span<const double> area) {
    assert(density.size() == area.size());
    std::vector<std::size_t> order(density.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return density[a] < density[b]; });
    double all_area = 0.0, amount = 0.0, under_curve = 0.0;
    for (std::size_t k : order) {
        const double next = amount + density[k] * area[k];
        under_curve += 0.5 * (amount + next) * area[k];
        amount = next;
        all_area += area[k];
    }
    return amount > 0.0 ? 1.0 - 2.0 * under_curve / (amount * all_area) : 0.0;
}

Localisation measure_localisation(const Setting& setting, const State& state,
                                  const Strain& strain) {
    assert(state.clock.travel.m > 0.0);
    const bool whole = strain.applied > 0;
    const std::vector<double> so_far = whole ? std::vector<double>() : shear_strain(state);
    const std::span<const double> window =
        whole ? state.discs.get(dem::columns::window_strain) : std::span<const double>(so_far);
    const std::span<const double> total =
        whole ? state.discs.get(dem::columns::total_strain) : std::span<const double>(so_far);
    const BasementStrain s = basement_strain(
        state, window, total, 1.0 / seconds_of_window(setting, state, strain), setting.gravity);
    return {share_of_densest(s.last, s.area, densest), share_of_densest(s.sum, s.area, densest),
            gini(s.last, s.area), mean_of_densest(s.inertial, s.area)};
}

} // namespace listric::measures
