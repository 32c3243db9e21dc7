#include "apps/measures/paper/persistence.hpp"

#include "apps/support/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

constexpr dem::Extension lag(3e3);
constexpr double strained = 0.2; ///< share of the discs that counts as strained

constexpr Quantity persistence{
    "strain_persistence", "1", "persistence of strain",
    "correlation of the basement's strain in one window with that in the window 3 km of extension "
    "later, over the fifth of the discs that is strained most in both together: mean over all such "
    "pairs of windows so far. Zero or less for bands of the day"};

/// Strain of the basement's discs by id; NaN for sediment discs.
std::vector<double> strain_by_id(const RunSoFar& run, const ShearField& field) {
    std::vector<double> strain(run.places.row_of.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t k = 0; k < field.id.size(); ++k)
        if (run.discs.stratum[run.row(field, k)] == 0)
            strain[static_cast<std::size_t>(field.id[k])] = field.shear(k);
    return strain;
}

} // namespace

std::optional<double> strain_correlation(std::span<const double> early,
                                         std::span<const double> late, double share) {
    constexpr std::size_t fewest = 20; // discs
    assert(early.size() == late.size());
    std::vector<std::size_t> discs;
    for (std::size_t k = 0; k < early.size(); ++k)
        if (std::isfinite(early[k]) && std::isfinite(late[k]))
            discs.push_back(k);
    std::ranges::stable_sort(discs, std::ranges::greater{},
                             [&](std::size_t k) { return early[k] + late[k]; });
    discs.resize(static_cast<std::size_t>(share * static_cast<double>(discs.size())));
    if (discs.size() < fewest)
        return std::nullopt;
    std::vector<double> a, b;
    for (const std::size_t k : discs) {
        a.push_back(early[k]);
        b.push_back(late[k]);
    }
    const Spread of_a = spread(a), of_b = spread(b);
    double product = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
        product += (a[k] - of_a.mean) * (b[k] - of_b.mean);
    const double all = static_cast<double>(a.size() - 1) * of_a.deviation * of_b.deviation;
    return all > 0.0 ? std::optional(product / all) : std::nullopt;
}

NamedNumbers measure_persistence(const RunSoFar& run) {
    std::vector<std::vector<double>> strains; // by window
    std::vector<double> correlations;
    for (std::size_t k = 0; k < run.past.size(); ++k) {
        const ShearField field = run.window(k);
        strains.push_back(strain_by_id(run, field));
        const Extension wanted = run.end_of_window(k).extension - lag;
        for (std::size_t early = 0; early < k; ++early)
            if (std::abs((run.end_of_window(early).extension - wanted).m) < 0.5 * field.window.m)
                if (const auto r = strain_correlation(strains[early], strains[k], strained))
                    correlations.push_back(*r);
    }
    NamedNumbers numbers;
    if (!correlations.empty())
        add(numbers, persistence, spread(correlations).mean);
    return numbers;
}

std::span<const Quantity> persistence_quantities() {
    static constexpr Quantity all[] = {persistence};
    return all;
}

} // namespace listric::measures
