#include "apps/measures/grabens.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace listric::measures {

namespace {

/// When a collapse graben first appears, when there first are two, and whether the one before is
/// then the outer one.
NamedNumbers measure_order(std::span<const Past> past) {
    constexpr double apart = 2e3; // what is nearer together is one graben
    NamedNumbers numbers;
    std::optional<double> alone; // place of the only one, less the extension
    for (const Past& p : past) {
        const double e = p.places.extension;
        std::vector<double> places;
        if (e > 0.0)
            for (const Depocentre& b : collapse_grabens(p.basins))
                places.push_back(b.x - e);
        if (places.empty())
            continue;
        const auto [inner, outer] = std::ranges::minmax(places);
        if (!alone)
            add(numbers, "first_graben_at_m", e);
        if (outer - inner >= apart) {
            add(numbers, "second_graben_at_m", e);
            if (alone)
                add(numbers, "outer_graben_first",
                    std::abs(outer - *alone) < std::abs(inner - *alone));
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
    add(numbers, "basins", static_cast<double>(basins.size()));
    add(numbers, "collapse_grabens", static_cast<double>(grabens.size()));
    add(numbers, "collapse_graben_prominence_m", most);
    append(numbers, measure_order(run.past));
    return numbers;
}

} // namespace listric::measures
