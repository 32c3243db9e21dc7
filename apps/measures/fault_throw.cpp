#include "apps/measures/fault_throw.hpp"

#include "apps/measures/rigid_motion.hpp"
#include "apps/measures/split.hpp"
#include "apps/support/statistics.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/hypotenuse.hpp"
#include "dem/units.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

// Mean diameters.
constexpr double nearest_column = 3.0, farthest_column = 15.0; ///< beside the trace
constexpr double extended = 15.0;                              ///< the trace, upward
constexpr double thinnest = 3.0;                               ///< a stratum that has a throw

constexpr double filled = 0.83; ///< share of the plane that discs fill

/// A disc beside a fault.
struct BesideFault {
    Point at;            ///< m
    double radius = 0.0; ///< m
    int stratum = 0;
    bool on_left = false;     ///< of the downward direction
    bool is_near_top = false; ///< of its stratum
};

/// The trace with its upper end drawn out straight.
Polyline extended_upward(const Polyline& trace, double length) {
    Polyline line = trace;
    const Point below = trace[std::min<std::size_t>(6, trace.size() - 1)];
    const Point up = trace.front() - below;
    const double d = norm(up);
    line.insert(line.begin(),
                {trace.front().x + length * up.x / d, trace.front().y + length * up.y / d});
    return line;
}

std::vector<BesideFault> discs_beside(const State& state, const Polyline& line, double diameter) {
    const ConstDiscColumns d = disc_columns(state);
    // Columns are upright and the line is not: a disc of a column may be this far from it.
    const double reach = 2.0 * farthest_column * diameter;
    std::vector<BesideFault> discs;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const PolylinePlace place = place_on(line, {d.x[i], d.y[i]});
        if (std::abs(place.distance) < reach)
            discs.push_back({{d.x[i], d.y[i]},
                             d.radius[i],
                             d.stratum[i],
                             place.distance > 0.0,
                             d.stratum[i] > 0 || d.start_y[i] > -1.5 * diameter});
    }
    return discs;
}

/// By stratum: travel at which it was laid down, m; the pre-rift top: before all.
std::map<int, double> strata_of(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    std::map<int, double> strata{{0, -std::numeric_limits<double>::infinity()}};
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] > 0)
            strata[d.stratum[i]] = d.start_travel[i];
    return strata;
}

/// Leaves out what is older than a fault but the surface that it broke, the youngest such stratum.
void leave_out_older(std::map<int, double>& strata, Travel born_at) {
    constexpr double tolerance = 1.0; // m: a window and a stratum may end in the same cycle
    while (strata.size() > 1 && std::next(strata.begin())->second < born_at.m - tolerance)
        strata.erase(strata.begin());
}

/// Mean height of a stratum's discs on both sides, m. None if a side has none.
std::optional<double> mean_height(std::span<const BesideFault> discs, int stratum) {
    double height[2] = {}, count[2] = {};
    for (const BesideFault& disc : discs)
        if (disc.stratum == stratum && disc.is_near_top) {
            height[disc.on_left] += disc.at.y;
            count[disc.on_left] += 1.0;
        }
    if (count[0] == 0.0 || count[1] == 0.0)
        return std::nullopt;
    return 0.5 * (height[0] / count[0] + height[1] / count[1]);
}

/// x where a line that falls comes to a height, m; none if it does not.
std::optional<double> crossing(const Polyline& line, double y) {
    const auto next = std::ranges::find_if(line, [&](Point p) { return p.y < y; });
    if (next == line.begin() || next == line.end())
        return std::nullopt;
    const Point a = *(next - 1), b = *next;
    return a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
}

/// Tops of a stratum and all below it on one side of a fault, in columns one diameter wide: sums
/// for a line through them.
struct Side {
    double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    double area = 0.0; ///< of the stratum's discs, m^2

    void add(Point top) {
        count += 1.0;
        x += top.x;
        y += top.y;
        xx += top.x * top.x;
        xy += top.x * top.y;
    }
    double spread() const { return xx - x * x / count; }
    double tilt_moment() const { return xy - x * y / count; }
};

/// The top in one column: between the discs below it and those above, or on the highest disc. None
/// in a column without disc of the stratum.
/// @param discs  of the column
std::optional<double> top_of(std::span<const BesideFault> discs, int stratum) {
    std::vector<MarkedPlace> places;
    double highest = -std::numeric_limits<double>::infinity();
    bool has_above = false, has_stratum = false;
    for (const BesideFault& disc : discs) {
        places.push_back({disc.at.y, disc.stratum <= stratum});
        highest = std::max(highest, disc.at.y + disc.radius);
        has_above = has_above || disc.stratum > stratum;
        has_stratum = has_stratum || disc.stratum == stratum;
    }
    if (!has_stratum)
        return std::nullopt;
    if (!has_above)
        return highest;
    const auto split = best_split(std::move(places));
    return split ? std::optional(split->at) : std::nullopt;
}

/// @param x  where the line crosses the stratum, m
Side side_of(std::span<const BesideFault> discs, bool left, double x, int stratum,
             double diameter) {
    const double outward = left ? 1.0 : -1.0; // the left of a direction downward is at larger x
    constexpr auto columns = static_cast<std::size_t>(farthest_column - nearest_column);
    std::vector<std::vector<BesideFault>> in_column(columns);
    Side side;
    for (const BesideFault& disc : discs) {
        const double column = outward * (disc.at.x - x) / diameter - nearest_column;
        if (disc.on_left != left || column < 0.0 || column >= static_cast<double>(columns))
            continue;
        in_column[static_cast<std::size_t>(column)].push_back(disc);
        if (disc.stratum == stratum)
            side.area += pi * disc.radius * disc.radius;
    }
    for (const auto& column : in_column)
        if (const auto top = top_of(column, stratum)) {
            double middle = 0.0;
            for (const BesideFault& disc : column)
                middle += disc.at.x / static_cast<double>(column.size());
            side.add({middle - x, *top});
        }
    return side;
}

/// A stratum's top on both sides of a fault.
struct Tops {
    int stratum = 0;
    Side left, right;

    double spread() const { return left.spread() + right.spread(); }
    double tilt_moment() const { return left.tilt_moment() + right.tilt_moment(); }
    /// Where the fault is, of lines of a tilt, m.
    double height_on_left(double tilt) const { return (left.y - tilt * left.x) / left.count; }
    double height_on_right(double tilt) const { return (right.y - tilt * right.x) / right.count; }
};

/// Whether a stratum is thick enough, in the mean of both sides, to have a throw.
bool is_resolved(const Side& left, const Side& right, double diameter) {
    const double width = 2.0 * (farthest_column - nearest_column) * diameter;
    return left.area + right.area >= thinnest * diameter * filled * width;
}

/// None if the fault does not cross the stratum, or a side has too few columns of it.
std::optional<Tops> tops_beside(std::span<const BesideFault> discs, const Polyline& line,
                                int stratum, double diameter) {
    constexpr int rounds = 3;      // the fault is crossed half way between both heights
    constexpr double fewest = 5.0; // columns on a side
    auto y = mean_height(discs, stratum);
    Tops tops{stratum, {}, {}};
    for (int n = 0; n < rounds; ++n) {
        const auto x = y ? crossing(line, *y) : std::nullopt;
        if (!x)
            return std::nullopt;
        tops.left = side_of(discs, true, *x, stratum, diameter);
        tops.right = side_of(discs, false, *x, stratum, diameter);
        if (tops.left.count < fewest || tops.right.count < fewest)
            return std::nullopt;
        const double tilt = tops.tilt_moment() / tops.spread();
        y = 0.5 * (tops.height_on_left(tilt) + tops.height_on_right(tilt));
    }
    return tops;
}

/// Tilt of the top k and the two next to it, which lie alike: one alone is known too badly.
double tilt_around(std::span<const Tops> tops, std::size_t k) {
    double moment = 0.0, spread = 0.0;
    for (std::size_t m = k > 0 ? k - 1 : 0; m < std::min(k + 2, tops.size()); ++m) {
        moment += tops[m].tilt_moment();
        spread += tops[m].spread();
    }
    return moment / spread;
}

/// Height of the trace, and of the layer beside it at the start, m.
struct Layer {
    double now, start;
};

/// Layers along one side of a trace, from top to bottom.
/// @param offset  of the discs that say so, m into the footwall
std::vector<Layer> layers_beside(const State& state, const Cells& cells, const Polyline& trace,
                                 double offset, double reach) {
    constexpr std::size_t fewest = 8; // discs beside a point
    const ConstDiscColumns d = disc_columns(state);
    std::vector<Layer> layers;
    for (std::size_t k = 0; k < trace.size(); ++k) {
        const Point centre = trace[k] + offset * footwall_normal(trace, k);
        RigidMotion back;
        cells.for_each_near(centre.x, centre.y, [&](std::int32_t row) {
            const auto i = static_cast<std::size_t>(row);
            if (d.stratum[i] == 0 && hypotenuse(d.x[i] - centre.x, d.y[i] - centre.y) < reach)
                back.add({d.x[i], d.y[i]}, {d.start_x[i], d.start_y[i]});
        });
        if (back.size() < fewest)
            continue;
        back.fit();
        // Above the pre-rift top there is no layer that the side's motion could bring back.
        if (const double start = back.move(trace[k]).y; start <= 0.0)
            layers.push_back({trace[k].y, start});
    }
    return layers;
}

} // namespace

std::map<int, Cutoffs> fault_cutoffs(const State& state, const Polyline& trace, Travel born_at) {
    assert(trace.size() > 1);
    const double diameter = 2.0 * state.mean_radius;
    const Polyline line = extended_upward(trace, extended * diameter);
    const std::vector<BesideFault> discs = discs_beside(state, line, diameter);
    std::map<int, double> strata = strata_of(state);
    leave_out_older(strata, born_at);
    std::vector<Tops> all;
    for (const auto& [stratum, laid_down_at] : strata)
        if (auto tops = tops_beside(discs, line, stratum, diameter))
            all.push_back(*tops);
    std::map<int, Cutoffs> cutoffs;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Tops& tops = all[k];
        const double tilt = tilt_around(all, k);
        const double left = tops.height_on_left(tilt), right = tops.height_on_right(tilt);
        // The left of the downward direction is above a fault that falls right.
        cutoffs[tops.stratum] = {.hanging = falls_right(line) ? left : right,
                                 .footwall = falls_right(line) ? right : left,
                                 .is_resolved = tops.stratum == 0 ||
                                                is_resolved(tops.left, tops.right, diameter)};
    }
    return cutoffs;
}

std::map<int, double> throws_of(const std::map<int, Cutoffs>& cutoffs) {
    std::map<int, double> throws;
    for (const auto& [stratum, cutoff] : cutoffs)
        if (cutoff.is_resolved)
            throws[stratum] = cutoff.offset();
    return throws;
}

std::map<int, double> fault_throws(const State& state, const Polyline& trace, Travel born_at) {
    return throws_of(fault_cutoffs(state, trace, born_at));
}

std::optional<double> pre_rift_throw(const State& state, const Polyline& trace) {
    assert(trace.size() > 1);
    constexpr std::size_t fewest = 4; // layers
    const ConstDiscColumns d = disc_columns(state);
    const double diameter = 2.0 * state.mean_radius;
    const double reach = 3.0 * diameter, offset = 6.0 * diameter;
    const Cells cells(d.x, d.y, reach);
    const std::vector<Layer> footwall = layers_beside(state, cells, trace, offset, reach);
    const std::vector<Layer> hanging_wall = layers_beside(state, cells, trace, -offset, reach);
    std::vector<double> throws;
    for (const Layer& layer : hanging_wall)
        for (std::size_t k = 0; k + 1 < footwall.size(); ++k) {
            const Layer &up = footwall[k], &down = footwall[k + 1];
            if (up.start >= layer.start && down.start < layer.start) {
                const double share = (up.start - layer.start) / (up.start - down.start);
                throws.push_back(up.now + share * (down.now - up.now) - layer.now);
                break;
            }
        }
    return throws.size() < fewest ? std::nullopt : std::optional(median(std::move(throws)));
}

} // namespace listric::measures
