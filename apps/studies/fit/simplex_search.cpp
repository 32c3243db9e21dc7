#include "apps/studies/fit/simplex_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace listric {

SimplexMinimum simplex_minimum(const std::function<double(std::span<const double>)>& function,
                               std::span<const double> start, std::span<const double> step,
                               std::span<const double> lower, std::span<const double> upper,
                               int evaluations) {
    int left = evaluations;
    const auto at = [&](std::vector<double> place) {
        for (std::size_t p = 0; p < place.size(); ++p)
            place[p] = std::clamp(place[p], lower[p], upper[p]);
        --left;
        const double value = function(place);
        return SimplexMinimum{std::move(place), value};
    };
    std::vector<SimplexMinimum> simplex{at({start.begin(), start.end()})};
    for (std::size_t p = 0; p < start.size(); ++p)
        if (step[p] != 0.0) {
            std::vector<double> place(start.begin(), start.end());
            const bool is_inside = place[p] + step[p] <= upper[p] && place[p] + step[p] >= lower[p];
            place[p] += is_inside ? step[p] : -step[p];
            simplex.push_back(at(std::move(place)));
        }
    const std::size_t last = simplex.size() - 1;
    const auto sort = [&] { std::ranges::stable_sort(simplex, {}, &SimplexMinimum::value); };
    sort();
    while (left > 0 && last > 0) {
        std::vector<double> middle(start.size());
        for (std::size_t k = 0; k < last; ++k)
            for (std::size_t p = 0; p < middle.size(); ++p)
                middle[p] += simplex[k].at[p] / static_cast<double>(last);
        const auto along = [&](double factor) {
            std::vector<double> place(middle.size());
            for (std::size_t p = 0; p < place.size(); ++p)
                place[p] = std::lerp(middle[p], simplex[last].at[p], factor);
            return at(std::move(place));
        };
        SimplexMinimum next = along(-1.0);
        if (next.value < simplex[0].value) {
            if (SimplexMinimum further = along(-2.0); further.value < next.value)
                next = std::move(further);
        } else if (next.value >= simplex[last - 1].value) {
            if (SimplexMinimum nearer = along(next.value < simplex[last].value ? -0.5 : 0.5);
                nearer.value < std::min(next.value, simplex[last].value))
                next = std::move(nearer);
        }
        if (next.value < simplex[last].value) {
            simplex[last] = std::move(next);
        } else { // nothing along the line is better: all come nearer to the best
            for (std::size_t k = 1; k <= last; ++k) {
                std::vector<double> place = simplex[k].at;
                for (std::size_t p = 0; p < place.size(); ++p)
                    place[p] = std::midpoint(place[p], simplex[0].at[p]);
                simplex[k] = at(std::move(place));
            }
        }
        sort();
    }
    return simplex[0];
}

} // namespace listric
