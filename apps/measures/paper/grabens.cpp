#include "apps/measures/paper/grabens.hpp"

#include "apps/support/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace listric::measures {

namespace {

constexpr Quantity basin_count{"basins", "1", "basins",
                               "maxima of the depth of the pre-rift top (smoothed over 1 km) with "
                               "a prominence of 250 m or more"};
constexpr Quantity graben_count{"collapse_grabens", "1", "collapse grabens",
                                "number of basins except the one nearest the breakaway"};
constexpr Quantity graben_prominence{"collapse_graben_prominence_m", "m",
                                     "prominence of the collapse graben",
                                     "largest prominence of a collapse graben"};
constexpr Quantity first_graben{"first_graben_at_m", "m", "first collapse graben at",
                                "extension of the first snapshot with a collapse graben"};
constexpr Quantity second_graben{
    "second_graben_at_m", "m", "second collapse graben at",
    "extension of the first snapshot with two collapse grabens that are 2 km apart"};
constexpr Quantity outer_first{
    "outer_graben_first", "1", "outer graben first",
    "order of the collapse grabens: 1 if the one farther from the breakaway formed first, 0 if the "
    "nearer one did (places less the extension, since grabens move with the right wall)"};

/// When a collapse graben first appears, when there first are two, and whether the one before is
/// then the outer one.
NamedNumbers measure_order(std::span<const Past> past) {
    constexpr double apart = 2e3; // grabens nearer together are one
    NamedNumbers numbers;
    std::optional<double> alone; // place of the only one, less the extension
    for (const Past& p : past) {
        const double e = p.places.extension.m;
        std::vector<double> places;
        if (e > 0.0)
            for (const Depocentre& b : collapse_grabens(p.basins))
                places.push_back(b.x - e);
        if (places.empty())
            continue;
        const auto [inner, outer] = std::ranges::minmax(places);
        if (!alone)
            add(numbers, first_graben, e);
        if (outer - inner >= apart) {
            add(numbers, second_graben, e);
            if (alone)
                add(numbers, outer_first, std::abs(outer - *alone) < std::abs(inner - *alone));
            break;
        }
        alone = outer;
    }
    return numbers;
}

} // namespace

NamedNumbers measure_grabens(const RunSoFar& run) {
    const std::vector<Depocentre> basins = find_basins(run.profile);
    const std::vector<Depocentre> grabens = collapse_grabens(basins);
    double most = 0.0;
    for (const Depocentre& b : grabens)
        most = std::max(most, b.prominence);
    NamedNumbers numbers;
    add(numbers, basin_count, static_cast<double>(basins.size()));
    add(numbers, graben_count, static_cast<double>(grabens.size()));
    add(numbers, graben_prominence, most);
    append(numbers, measure_order(run.past));
    return numbers;
}

std::span<const Quantity> graben_quantities() {
    static constexpr Quantity all[] = {basin_count,  graben_count,  graben_prominence,
                                       first_graben, second_graben, outer_first};
    return all;
}

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
