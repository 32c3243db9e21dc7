#include "apps/measures/paper/grabens.hpp"

#include <algorithm>
#include <cmath>
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

} // namespace listric::measures
