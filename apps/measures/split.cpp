#include "apps/measures/split.hpp"

#include <algorithm>
#include <cstddef>

namespace listric::measures {

std::optional<Split> best_split(std::vector<MarkedPlace> places) {
    std::ranges::sort(places, {}, &MarkedPlace::at);
    std::ptrdiff_t wrong = std::ranges::count_if(places, &MarkedPlace::below);
    std::ptrdiff_t least = wrong;
    std::vector<std::size_t> best{0}; // how many places are below the boundary
    for (std::size_t k = 0; k < places.size(); ++k) {
        wrong += places[k].below ? -1 : 1;
        if (wrong < least)
            best.clear();
        if (wrong <= least)
            best.push_back(k + 1);
        least = std::min(least, wrong);
    }
    if (best.front() == 0 || best.back() == places.size())
        return std::nullopt;
    Split split{0.0, static_cast<double>(least) / static_cast<double>(places.size())};
    for (const std::size_t k : best)
        split.at += 0.5 * (places[k - 1].at + places[k].at) / static_cast<double>(best.size());
    return split;
}

} // namespace listric::measures
