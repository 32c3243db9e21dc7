#include "apps/measures/faults/broken_rock.hpp"

#include "dem/contacts/cells.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/numbers/point.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

constexpr double around = 1.6;         ///< a disc, pairs that say whether it is broken, diameters
constexpr double most_unbonded = 0.35; ///< share of those pairs in sound rock
constexpr double far_off = 4.0;        ///< from sound rock, diameters
constexpr double farthest = 64.0;      ///< from sound rock that is looked for, diameters

/// Discs or pairs by place, m.
struct Places {
    std::vector<double> x, y;

    void add(Point p) {
        x.push_back(p.x);
        y.push_back(p.y);
    }
    Point operator[](std::size_t k) const { return {x[k], y[k]}; }
};

/// Whether each of the discs lies in broken rock.
std::vector<char> broken(const State& state, const Places& discs, double reach) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const std::vector<bool> touches = touching(state);
    Places pairs;
    std::vector<char> bonded;
    for (std::size_t k = 0; k < touches.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]);
        const auto j = static_cast<std::size_t>(c.second[k]);
        if (!touches[k] || d.stratum[i] != 0 || d.stratum[j] != 0)
            continue;
        pairs.add({0.5 * (d.x[i] + d.x[j]), 0.5 * (d.y[i] + d.y[j])});
        bonded.push_back(c.bonded[k] ? 1 : 0);
    }
    const Cells cells(pairs.x, pairs.y, reach);
    std::vector<char> result(discs.x.size());
    for (std::size_t k = 0; k < result.size(); ++k) {
        double near = 0.0, without = 0.0;
        cells.for_each_near(discs.x[k], discs.y[k], [&](std::int32_t row) {
            const auto pair = static_cast<std::size_t>(row);
            if (const Point off = pairs[pair] - discs[k]; dot(off, off) <= reach * reach) {
                near += 1.0;
                without += bonded[pair] ? 0.0 : 1.0;
            }
        });
        result[k] = without >= most_unbonded * near ? 1 : 0;
    }
    return result;
}

/// Distance of each of the discs in `from` from the nearest of those in `to`, m; at most
/// `most`.
std::vector<double> distances(const Places& from, const Places& to, double nearby, double most) {
    std::vector<double> result(from.x.size(), most);
    std::vector<std::size_t> left(result.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    // In wider and wider surroundings: most discs are near.
    for (double reach = nearby; !left.empty() && reach <= most; reach *= 2.0) {
        const Cells cells(to.x, to.y, reach);
        std::erase_if(left, [&](std::size_t k) {
            double square = reach * reach;
            bool found = false;
            cells.for_each_near(from.x[k], from.y[k], [&](std::int32_t row) {
                const Point off = to[static_cast<std::size_t>(row)] - from[k];
                if (dot(off, off) <= square) {
                    square = dot(off, off);
                    found = true;
                }
            });
            if (found)
                result[k] = std::sqrt(square);
            return found;
        });
    }
    return result;
}

} // namespace

BrokenRock measure_broken_rock(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const double diameter = 2.0 * state.mean_radius;
    Places rock;
    std::vector<double> area;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] == 0) {
            rock.add({d.x[i], d.y[i]});
            area.push_back(d.radius[i] * d.radius[i]);
        }
    const std::vector<char> is_broken = broken(state, rock, around * diameter);
    Places loose, sound;
    double all = 0.0, far = 0.0, loose_area = 0.0;
    std::vector<double> loose_areas;
    for (std::size_t k = 0; k < area.size(); ++k) {
        all += area[k];
        (is_broken[k] ? loose : sound).add(rock[k]);
        if (is_broken[k])
            loose_areas.push_back(area[k]);
    }
    const std::vector<double> away = distances(loose, sound, 2.0 * diameter, farthest * diameter);
    BrokenRock found;
    for (std::size_t k = 0; k < away.size(); ++k) {
        loose_area += loose_areas[k];
        found.width += loose_areas[k] * away[k] / diameter;
        far += away[k] > far_off * diameter ? loose_areas[k] : 0.0;
    }
    found.width = loose_area > 0.0 ? found.width / loose_area : 0.0;
    found.areal_share = all > 0.0 ? far / all : 0.0;
    return found;
}

} // namespace listric::measures
