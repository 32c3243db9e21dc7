#include "apps/measures/basin/depocentres.hpp"

#include <algorithm>
#include <cassert>
#include <functional>

namespace listric::measures {

namespace {

/// Height of maximum k, which is a plateau up to `last`, over the higher of the two lowest passes
/// to something thicker, m; over nothing if there is nothing thicker.
double prominence(std::span<const double> t, std::size_t k, std::size_t last) {
    double left = t[k], right = t[k];
    bool left_higher = false, right_higher = false;
    for (std::size_t m = k; m-- > 0 && !left_higher;) {
        left_higher = t[m] > t[k];
        left = std::min(left, t[m]);
    }
    for (std::size_t m = last + 1; m < t.size() && !right_higher; ++m) {
        right_higher = t[m] > t[k];
        right = std::min(right, t[m]);
    }
    const double base = left_higher && right_higher ? std::max(left, right)
                        : left_higher               ? left
                        : right_higher              ? right
                                                    : 0.0;
    return t[k] - base;
}

} // namespace

std::vector<Depocentre> find_depocentres(std::span<const double> x, std::span<const double> t,
                                         double least_prominence) {
    assert(x.size() == t.size());
    std::vector<Depocentre> found;
    for (std::size_t k = 0; k < t.size(); ++k) {
        // A plateau counts once, at its first sample.
        if (t[k] <= 0.0 || (k > 0 && t[k - 1] >= t[k]))
            continue;
        std::size_t last = k;
        while (last + 1 < t.size() && t[last + 1] == t[k])
            ++last;
        if (last + 1 < t.size() && t[last + 1] > t[k])
            continue;
        if (const double height = prominence(t, k, last); height >= least_prominence)
            found.push_back({x[k], t[k], height});
    }
    std::ranges::sort(found, std::ranges::greater{}, &Depocentre::thickness);
    return found;
}

std::vector<Depocentre> find_basins(const Profile& profile) {
    return find_depocentres(profile.x, smoothed_depth(profile), depocentre_prominence);
}

std::vector<Depocentre> collapse_grabens(std::span<const Depocentre> basins) {
    if (basins.empty())
        return {};
    const double first = std::ranges::min(basins, {}, &Depocentre::x).x;
    std::vector<Depocentre> grabens;
    for (const Depocentre& b : basins)
        if (b.x > first)
            grabens.push_back(b);
    return grabens;
}

std::optional<std::size_t> find_intervening_high(std::span<const double> x,
                                                 std::span<const double> depth,
                                                 double least_prominence) {
    const std::vector<Depocentre> all = find_depocentres(x, depth, least_prominence);
    if (all.size() < 2)
        return std::nullopt;
    const double first = std::ranges::min(all, {}, &Depocentre::x).x;
    double second = first, most = 0.0;
    for (const Depocentre& d : all)
        if (d.x > first && d.prominence > most) {
            second = d.x;
            most = d.prominence;
        }
    std::optional<std::size_t> high;
    for (std::size_t k = 0; k < x.size(); ++k)
        if (x[k] > first && x[k] < second && (!high || depth[k] < depth[*high]))
            high = k;
    return high;
}

} // namespace listric::measures
