#include "apps/measures/faults/fault_throw.hpp"

#include "apps/measures/faults/bed_plane.hpp"
#include "apps/measures/split.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace listric::measures {

using namespace dem;

namespace {

// Units.
constexpr double nearest_disc = 3.0;                 ///< disc beside a trace: drag reaches less far
constexpr double near_reach = 9.0, far_reach = 15.0; ///< disc beside a trace
constexpr double straight_on = 8.0;               ///< from the next of a horizon's discs to its cut
constexpr double extension_up = 15.0;             ///< the trace, upward
constexpr double rock_band = 3.0, top_band = 2.0; ///< discs above and below a horizon that count
constexpr double largest_throw_error = 2.0;       ///< of a throw
constexpr double trace_error = 0.5;               ///< of the place of a trace
constexpr double thinnest_stratum = 3.0;          ///< diameters: a stratum that has a throw

constexpr std::size_t fewest_marks = 10; ///< discs of a plane

/// A disc beside a fault.
struct BesideFault {
    Point at, start;       ///< m
    double distance = 0.0; ///< from the trace, m
    int stratum = 0;
};

/// Discs beside a fault, above it and below it.
struct FaultSides {
    std::vector<BesideFault> hanging, footwall;
};

/// The line in which horizons meet a fault.
struct CutLine {
    Polyline points;
    std::span<const Polyline> others; ///< faults
    double unit = 0.0;                ///< of lengths, m
};

/// The trace with its upper end drawn out straight.
Polyline extended_upward(const Polyline& trace, double length) {
    Polyline line = trace;
    const Point below = trace[std::min<std::size_t>(6, trace.size() - 1)];
    line.insert(line.begin(), trace.front() + length * unit(trace.front() - below));
    return line;
}

/// The trace's point next to another one.
Point point_next_to(const Polyline& trace, Point p) {
    return *std::ranges::min_element(trace, {}, [&](Point q) { return dot(q - p, q - p); });
}

/// Whether a place is in the drag of another fault, or has it between itself and the trace.
bool is_beyond(const Polyline& other, Point p, const Polyline& trace, double drag) {
    const PolylinePlace place = place_on(other, p);
    if (std::abs(place.distance) < drag)
        return true;
    if (place.beyond)
        return false;
    const PolylinePlace from = place_on(other, point_next_to(trace, p));
    return !from.beyond && (from.distance > 0.0) != (place.distance > 0.0);
}

FaultSides sides_of(const State& state, const ThrownFault& fault, const CutLine& line) {
    const ConstDiscColumns d = disc_columns(state);
    const bool right = falls_right(line.points);
    const double unit = line.unit;
    FaultSides sides;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const Point p{d.x[i], d.y[i]};
        const PolylinePlace place = place_on(line.points, p);
        const double distance = std::abs(place.distance);
        if (place.beyond || distance < nearest_disc * unit || distance > far_reach * unit ||
            std::ranges::any_of(line.others, [&](const Polyline& other) {
                return is_beyond(other, p, fault.trace, nearest_disc * unit);
            }))
            continue;
        // The left of the downward direction is above a fault that falls right.
        auto& side = (place.distance > 0.0) == right ? sides.hanging : sides.footwall;
        side.push_back({p, {d.start_x[i], d.start_y[i]}, distance, d.stratum[i]});
    }
    return sides;
}

/// Where a horizon meets a fault on one side.
struct HorizonCut {
    Point at;           ///< m
    double error = 0.0; ///< of its height, m
};

/// Whether a horizon reaches a place straight on from the discs that tell of it: it is next to one
/// of them, and no other fault lies between. Further away or beyond a fault it is another block's.
bool reaches(std::span<const Mark> discs, Point middle, Point place, const CutLine& line) {
    return std::ranges::any_of(
               discs,
               [&](const Mark& disc) { return norm(disc.at - place) < straight_on * line.unit; }) &&
           std::ranges::none_of(line.others, [&](const Polyline& other) {
               return are_parted(middle, place, other);
           });
}

/// Where a horizon, straight on, meets a line that falls; of several places the one next to the
/// discs that tell of it.
std::optional<HorizonCut> cut_of(const BedPlane& bed, std::span<const Mark> discs,
                                 const CutLine& line) {
    std::optional<HorizonCut> cut;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
        const Point a = line.points[k], step = line.points[k + 1] - a;
        const double up = bed.above(a), down = bed.above(line.points[k + 1]);
        if (!(up > 0.0 && down <= 0.0))
            continue;
        const Point at = a + (up / (up - down)) * step;
        if (const double away = norm(at - bed.middle()); away < least) {
            least = away;
            const Point slope = bed.slope(), n = unit(Point{-step.y, step.x});
            const double aside = dot(slope, n) * step.y / (up - down) + n.y;
            cut = {at, norm({bed.standard_error(at) * step.y / (up - down),
                             aside * trace_error * line.unit})};
        }
    }
    if (cut && !reaches(discs, bed.middle(), cut->at, line))
        cut.reset();
    return cut;
}

/// A horizon's cut on one side, found in two ways.
struct TwoCuts {
    std::optional<HorizonCut> first, second; ///< none of the second if it has no discs of its own
};

std::optional<BedPlane> plane_of(std::span<const Mark> marks) {
    if (marks.size() < fewest_marks)
        return std::nullopt;
    const MarkMoments moments(marks);
    return BedPlane::through(moments, moments);
}

// -- rock before extension

/// A horizon of the rock before extension, by its number.
struct RockHorizon {
    int number = 0;
    TargetLine line; ///< before extension
};

/// The pre-rift top, and below it boundaries of layers, or else one horizon each kilometre.
std::vector<RockHorizon> rock_horizons(const State& state, std::span<const LayerBoundary> layers) {
    constexpr double layer = 1000.0; // m, as those of HorizonOptions
    std::vector<RockHorizon> horizons{{0, TargetLine({{0.0, 0.0}})}};
    for (std::size_t k = 0; k < layers.size(); ++k)
        horizons.push_back({-static_cast<int>(k) - 1, layers[k].line});
    if (!layers.empty())
        return horizons;
    const ConstDiscColumns d = disc_columns(state);
    const double deepest = d.start_y.empty() ? 0.0 : *std::ranges::min_element(d.start_y);
    for (int k = 1; k * layer < -deepest; ++k)
        horizons.push_back({-k, TargetLine({{0.0, -k * layer}})});
    return horizons;
}

std::vector<Mark> rock_marks(std::span<const BesideFault> side, const TargetLine& horizon,
                             double unit, double reach) {
    std::vector<Mark> marks;
    for (const BesideFault& disc : side) {
        const double above = horizon.above(disc.start);
        if (disc.stratum == 0 && disc.distance < reach * unit && std::abs(above) < rock_band * unit)
            marks.push_back({disc.at, above});
    }
    return marks;
}

TwoCuts rock_cuts(std::span<const BesideFault> side, const CutLine& line,
                  const TargetLine& horizon) {
    const auto cut = [&](std::span<const Mark> marks) {
        const auto bed = plane_of(marks);
        return bed ? cut_of(*bed, marks, line) : std::nullopt;
    };
    const std::vector<Mark> near = rock_marks(side, horizon, line.unit, near_reach);
    const std::vector<Mark> all = rock_marks(side, horizon, line.unit, far_reach);
    constexpr double fewest_more = 1.2; // where another fault is near, none lies further away
    const bool has_more =
        static_cast<double>(all.size()) > fewest_more * static_cast<double>(near.size());
    return {cut(near), has_more ? cut(all) : std::nullopt};
}

// -- strata

/// When strata were laid down, by stratum.
std::map<int, Travel> when_laid_down(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    std::map<int, Travel> strata;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] > 0)
            strata[d.stratum[i]] = Travel(d.start_travel[i]);
    return strata;
}

/// Discs around a level line through their middle height between those of a stratum and below it
/// and those above: where the search for its top begins.
std::optional<BedPlane> level_top(std::span<const BesideFault> side, int stratum) {
    std::vector<MarkedPlace> places;
    for (const BesideFault& disc : side)
        places.push_back({disc.at.y, disc.stratum <= stratum});
    const auto split = best_split(std::move(places));
    if (!split)
        return std::nullopt;
    Point at{0.0, split->at};
    double count = 0.0;
    for (const BesideFault& disc : side)
        if (disc.stratum == stratum) {
            at.x += disc.at.x;
            count += 1.0;
        }
    if (count == 0.0)
        return std::nullopt;
    at.x /= count;
    // A level plane of slope 1.
    const Mark marks[] = {{at + Point{-1.0, -1.0}, -1.0},
                          {at + Point{1.0, -1.0}, -1.0},
                          {at + Point{-1.0, 1.0}, 1.0},
                          {at + Point{1.0, 1.0}, 1.0}};
    return BedPlane::through(MarkMoments(marks), MarkMoments(marks));
}

/// Discs next to the top of a stratum. A plane through 1 above it and -1 below it is 0 in the
/// middle of a band of discs; a band that is off by some distance comes to a third of it.
std::vector<Mark> marks_at_top(std::span<const BesideFault> side, int stratum, double unit) {
    auto bed = level_top(side, stratum);
    std::vector<Mark> marks;
    for (const double band : {4.0, 3.0, 2.5, 2.0, 2.0, 2.0, 2.0}) {
        if (!bed)
            return {};
        const double reach = band / 2.0 * top_band * unit * norm(bed->slope());
        marks.clear();
        for (const BesideFault& disc : side)
            if (std::abs(bed->above(disc.at)) < reach)
                marks.push_back({disc.at, disc.stratum <= stratum ? -1.0 : 1.0});
        bed = plane_of(marks);
    }
    return bed ? marks : std::vector<Mark>();
}

/// By stratum: the cut of its top, with the tilt of the tops next to it and with its own.
std::map<int, TwoCuts> top_cuts(std::span<const BesideFault> side, const CutLine& line,
                                const std::map<int, Travel>& strata) {
    struct Top {
        int stratum = 0;
        std::vector<Mark> marks;
        MarkMoments moments;
    };
    std::vector<Top> tops;
    for (const auto& [stratum, laid_down_at] : strata)
        if (auto marks = marks_at_top(side, stratum, line.unit); !marks.empty()) {
            const MarkMoments moments(marks);
            tops.push_back({stratum, std::move(marks), moments});
        }
    std::map<int, TwoCuts> cuts;
    for (std::size_t k = 0; k < tops.size(); ++k) {
        const Top& top = tops[k];
        MarkMoments spread = top.moments;
        if (k > 0)
            spread.add_spread(tops[k - 1].moments);
        if (k + 1 < tops.size())
            spread.add_spread(tops[k + 1].moments);
        TwoCuts& both = cuts[top.stratum];
        if (const auto bed = BedPlane::through(top.moments, spread))
            both.first = cut_of(*bed, top.marks, line);
        if (const auto bed = BedPlane::through(top.moments, top.moments))
            both.second = cut_of(*bed, top.marks, line);
    }
    return cuts;
}

// -- both sides

/// None unless the horizon meets the fault on both sides.
std::optional<Cutoffs> cutoffs_of(const TwoCuts& hanging, const TwoCuts& footwall, double unit) {
    if (!hanging.first || !footwall.first)
        return std::nullopt;
    Cutoffs both{hanging.first->at, footwall.first->at};
    // Without a second way the beds between are taken for straight to a unit.
    double other = unit;
    if (hanging.second || footwall.second)
        other = footwall.second.value_or(*footwall.first).at.y -
                hanging.second.value_or(*hanging.first).at.y - both.height();
    both.error = norm({norm({hanging.first->error, footwall.first->error}), other});
    both.is_resolved = both.error <= largest_throw_error * unit;
    return both;
}

/// Takes throws from strata that are too thin, or whose thickness is not known.
void leave_out_thin(std::map<int, Cutoffs>& cutoffs, double least) {
    for (auto& [stratum, top] : cutoffs) {
        if (stratum <= 0)
            continue;
        const auto base = cutoffs.find(stratum - 1);
        top.is_resolved =
            top.is_resolved && base != cutoffs.end() &&
            top.hanging.y - base->second.hanging.y + top.footwall.y - base->second.footwall.y >=
                2.0 * least;
    }
}

/// Marks the strata younger than the fault, and the youngest that is older.
void mark_growth(std::map<int, Cutoffs>& cutoffs, const std::map<int, Travel>& strata,
                 Travel born_at) {
    constexpr Travel tolerance(1.0); // a window and a stratum may end in the same cycle
    int broken = 0;
    for (const auto& [stratum, laid_down_at] : strata)
        if (laid_down_at < born_at - tolerance)
            broken = stratum;
    for (auto& [stratum, top] : cutoffs)
        top.is_of_growth = stratum >= broken;
}

} // namespace

std::map<int, Cutoffs> fault_cutoffs(const State& state, const ThrownFault& fault) {
    assert(fault.trace.size() > 1);
    const double diameter = 2.0 * state.mean_radius;
    const double unit = std::max(fault.unit, diameter);
    // Horizons that a fault cuts at a small angle would follow a trace's turns.
    const CutLine line{extended_upward(even(fault.trace, unit), extension_up * unit), fault.others,
                       unit};
    const FaultSides sides = sides_of(state, fault, line);
    std::map<int, Cutoffs> cutoffs;
    for (const auto& [number, horizon] : rock_horizons(state, fault.layers))
        if (const auto both = cutoffs_of(rock_cuts(sides.hanging, line, horizon),
                                         rock_cuts(sides.footwall, line, horizon), unit))
            cutoffs[number] = *both;
    const std::map<int, Travel> strata = when_laid_down(state);
    const std::map<int, TwoCuts> hanging = top_cuts(sides.hanging, line, strata);
    const std::map<int, TwoCuts> footwall = top_cuts(sides.footwall, line, strata);
    for (const auto& [stratum, cuts] : hanging)
        if (const auto below = footwall.find(stratum); below != footwall.end())
            if (const auto both = cutoffs_of(cuts, below->second, unit))
                cutoffs[stratum] = *both;
    leave_out_thin(cutoffs, thinnest_stratum * diameter);
    mark_growth(cutoffs, strata, fault.born_at);
    return cutoffs;
}

std::map<int, double> throws_of(const std::map<int, Cutoffs>& cutoffs) {
    std::map<int, double> throws;
    for (const auto& [number, at] : cutoffs)
        if (at.is_resolved)
            throws[number] = at.height();
    return throws;
}

std::map<int, double> growth_throws_of(const std::map<int, Cutoffs>& cutoffs) {
    std::map<int, double> throws;
    for (const auto& [number, at] : cutoffs)
        if (at.is_resolved && at.is_of_growth)
            throws[number] = at.height();
    return throws;
}

std::optional<double> pre_rift_throw_of(const std::map<int, Cutoffs>& cutoffs) {
    std::optional<double> greatest;
    for (const auto& [number, at] : cutoffs)
        if (at.is_resolved && number <= 0 &&
            (!greatest || std::abs(at.height()) > std::abs(*greatest)))
            greatest = at.height();
    return greatest;
}

} // namespace listric::measures
