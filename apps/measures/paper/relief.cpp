#include "apps/measures/paper/relief.hpp"

#include "apps/measures/faults/main_faults.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

constexpr double resolved = 3.0; ///< mean diameters between strata that have a value

constexpr Quantity correlation{
    "relief_youth_correlation", "1", "correlation of relief with stratum",
    "rank correlation (Spearman) of the relief of strata across the inner margin of the collapse "
    "graben with their youth, -1 where each younger one has less. Relief: highest top of the "
    "stratum (smoothed over 1 km) between halfgraben and graben less its lowest top in the graben, "
    "known to a disc's diameter. Strata that lie closer than three diameters on the graben's floor "
    "count as one; none for fewer than five"};
constexpr Quantity count{"relief_strata", "1", "strata with a relief",
                         "number of the strata of `relief_youth_correlation`"};
constexpr Quantity antithetic{
    "antithetic_relief_m", "m", "relief at the graben's outer margin",
    "relief of the pre-rift top at the outer margin of the collapse graben, on the antithetic "
    "fault's side: highest top beyond the graben less the lowest in it"};
constexpr Quantity synthetic{
    "synthetic_relief_m", "m", "relief at the graben's inner margin",
    "relief of the pre-rift top at the inner margin of the collapse graben, on the synthetic "
    "fault's side"};
constexpr Quantity ratio{"antithetic_over_synthetic_relief", "1",
                         "relief at the outer over that at the inner margin",
                         "`antithetic_relief_m` over `synthetic_relief_m`"};

/// Columns of the halfgraben's floor, the intervening high and the collapse graben's floor.
struct Columns {
    std::size_t halfgraben, high, graben;
};

std::optional<Columns> find_columns(const Profile& profile) {
    const std::vector<Depocentre> basins = find_basins(profile);
    const auto high =
        find_intervening_high(profile.x, smoothed_depth(profile), depocentre_prominence);
    if (!high)
        return std::nullopt;
    const auto column = [&](double x) {
        return static_cast<std::size_t>(std::ranges::lower_bound(profile.x, x) - profile.x.begin());
    };
    const std::vector<Depocentre> grabens = collapse_grabens(basins);
    return Columns{column(std::ranges::min(basins, {}, &Depocentre::x).x), *high,
                   column(std::ranges::max(grabens, {}, &Depocentre::prominence).x)};
}

/// Tops of a stratum and all below it by column, from the tops of the strata below it.
void raise(std::vector<double>& top, const State& state, int stratum) {
    const ConstDiscColumns d = disc_columns(state);
    const double width = 2.0 * state.mean_radius;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] != stratum || d.x[i] < 0.0)
            continue;
        if (const auto k = static_cast<std::size_t>(d.x[i] / width); k < top.size())
            top[k] = std::max(top[k], d.y[i] + d.radius[i]);
    }
}

} // namespace

std::optional<Relief> find_relief(const State& state, const Profile& profile) {
    const auto columns = find_columns(profile);
    if (!columns)
        return std::nullopt;
    const ConstDiscColumns d = disc_columns(state);
    const double diameter = 2.0 * state.mean_radius;
    const int youngest = std::ranges::max(d.stratum);
    std::vector<double> top = profile.pre_rift_top;
    Relief relief;
    std::optional<double> last; // height of the last resolved stratum on the graben's floor
    for (int stratum = 0; stratum <= youngest; ++stratum) {
        raise(top, state, stratum);
        const std::vector<double> smooth = smoothed(top, diameter);
        if (const double on_floor = smooth[columns->graben];
            last && on_floor - *last < resolved * diameter)
            continue;
        last = smooth[columns->graben];
        const auto at = [&](std::size_t k) {
            return smooth.begin() + static_cast<std::ptrdiff_t>(k);
        };
        const auto floor = std::min_element(at(columns->high), smooth.end());
        relief.inner[stratum] = *std::max_element(at(columns->halfgraben), floor + 1) - *floor;
        if (stratum == 0)
            relief.outer = *std::max_element(floor, smooth.end()) - *floor;
    }
    return relief;
}

NamedNumbers measure_relief(const RunSoFar& run) {
    const auto relief = find_relief(run.now, run.profile);
    if (!relief)
        return {};
    NamedNumbers numbers;
    add(numbers, correlation, throw_age_correlation(relief->inner));
    add(numbers, count, static_cast<double>(relief->inner.size()));
    add(numbers, antithetic, relief->outer);
    add(numbers, synthetic, relief->inner.at(0));
    add(numbers, ratio, relief->outer / relief->inner.at(0));
    return numbers;
}

std::span<const Quantity> relief_quantities() {
    static constexpr Quantity all[] = {correlation, count, antithetic, synthetic, ratio};
    return all;
}

} // namespace listric::measures
