#include "apps/measures/strata/horizons.hpp"

#include "apps/measures/strata/contour.hpp"
#include "apps/measures/strata/owner_map.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

namespace listric::measures {

using namespace dem;

namespace {

// Mean diameters.
constexpr double fineness = 1.0 / 6.0; ///< of the map
constexpr double blur = 1.0;           ///< standard deviation of the weights
constexpr double fault_reach = 1.5;    ///< a fault bends a horizon within this
constexpr double shortest = 3.0;       ///< piece or gap that is drawn
/// Share of a stratum around its top, below which it is absent: a twentieth of a disc's thickness.
constexpr double least_share = 0.02;

/// By disc: its stratum, or of pre-rift rock less the boundaries, or else the layers, above it at
/// the start.
std::vector<int> strata_of(const State& state, double layer,
                           std::span<const LayerBoundary> boundaries = {}) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<int> strata(d.stratum.begin(), d.stratum.end());
    for (std::size_t i = 0; i < strata.size(); ++i)
        if (strata[i] == 0 && !boundaries.empty())
            strata[i] = -static_cast<int>(
                std::ranges::count_if(boundaries, [&](const LayerBoundary& boundary) {
                    const double height = boundary.line.height(d.start_x[i]);
                    return height < 0.0 && d.start_y[i] < height;
                }));
        else if (strata[i] == 0 && layer > 0.0 && d.start_y[i] < 0.0)
            strata[i] = static_cast<int>(d.start_y[i] / layer);
    return strata;
}

/// Means with normal weights along rows, then along columns.
class Blur {
public:
    Blur(const OwnerMap& map, double deviation) : columns_(map.columns), rows_(map.rows) {
        const double places = deviation / map.spacing;
        const auto reach = static_cast<std::size_t>(std::ceil(3.0 * places));
        for (std::size_t k = 0; k <= reach; ++k) {
            const double place = static_cast<double>(k) / places;
            weights_.push_back(static_cast<float>(dem::exponential(-0.5 * place * place)));
        }
    }

    /// Sums, not divided by the sum of the weights.
    std::vector<float> operator()(const std::vector<float>& values) const {
        std::vector<float> along(values.size()), result(values.size());
        in_pieces(rows_, 16, [&](std::size_t row, std::size_t end) {
            for (; row < end; ++row)
                for (std::size_t k = 0; k < weights_.size(); ++k)
                    add_shifted(values.data() + row * columns_, along.data() + row * columns_, k);
        });
        in_pieces(rows_, 16, [&](std::size_t row, std::size_t end) {
            for (; row < end; ++row) {
                float* to = result.data() + row * columns_;
                for (std::size_t k = 0; k < weights_.size(); ++k) {
                    if (row >= k)
                        add_row(along.data() + (row - k) * columns_, to, weights_[k]);
                    if (k > 0 && row + k < rows_)
                        add_row(along.data() + (row + k) * columns_, to, weights_[k]);
                }
            }
        });
        return result;
    }

private:
    void add_row(const float* from, float* to, float weight) const {
        for (std::size_t c = 0; c < columns_; ++c)
            to[c] += weight * from[c];
    }
    void add_shifted(const float* from, float* to, std::size_t k) const {
        const float weight = weights_[k];
        for (std::size_t c = k; c < columns_; ++c)
            to[c] += weight * from[c - k];
        if (k > 0)
            for (std::size_t c = 0; c + k < columns_; ++c)
                to[c] += weight * from[c + k];
    }

    std::size_t columns_, rows_;
    std::vector<float> weights_; ///< by distance
};

/// How much of the rock around each place is of a stratum and those below it.
class Shares {
public:
    Shares(const OwnerMap& map, double deviation, std::vector<int> strata)
        : map_(map), blur_(map, deviation), strata_(std::move(strata)) {
        std::vector<float> inside(map.owner.size());
        for (std::size_t k = 0; k < inside.size(); ++k)
            inside[k] = map.owner[k] == OwnerMap::outside ? 0.0f : 1.0f;
        all_ = blur_(inside);
    }

    GridValues up_to(int stratum) const {
        std::vector<float> older(map_.owner.size());
        for (std::size_t k = 0; k < older.size(); ++k)
            older[k] =
                map_.owner[k] >= 0 && strata_[static_cast<std::size_t>(map_.owner[k])] <= stratum
                    ? 1.0f
                    : 0.0f;
        std::vector<float> share = blur_(older);
        for (std::size_t k = 0; k < share.size(); ++k)
            share[k] =
                all_[k] > 0.01f ? share[k] / all_[k] : std::numeric_limits<float>::quiet_NaN();
        return {map_.corner, map_.spacing, map_.columns, map_.rows, std::move(share)};
    }

private:
    const OwnerMap& map_;
    Blur blur_;
    std::vector<int> strata_;
    std::vector<float> all_;
};

/// The parts of a line inside the room.
std::vector<Polyline> within(const RockSpace& room, const Polyline& line) {
    std::vector<Polyline> parts;
    double last = -1.0;
    for (std::size_t k = 0; k < line.size(); ++k) {
        const double now = room.inside(line[k]);
        if (k > 0 && (now > 0.0) != (last > 0.0)) {
            const Point wall = line[k - 1] + (last / (last - now)) * (line[k] - line[k - 1]);
            if (now > 0.0)
                parts.emplace_back();
            parts.back().push_back(wall);
        } else if (k == 0 && now > 0.0) {
            parts.emplace_back();
        }
        if (now > 0.0)
            parts.back().push_back(line[k]);
        last = now;
    }
    return parts;
}

/// The line where the share is one half, in parts from base to base or wall.
std::vector<Polyline> tops(const GridValues& share, const RockSpace& room, double diameter) {
    std::vector<Polyline> found;
    for (const Polyline& line : contours(share, 0.5))
        for (Polyline& part : within(room, line))
            if (part.size() > 1 && length_of(part) > 2.0 * shortest * diameter) {
                Polyline smooth = even(part, 0.5 * diameter);
                smooth.push_back(part.back());
                found.push_back(std::move(smooth));
            }
    std::ranges::stable_sort(found, {}, [](const Polyline& line) { return line.front().x; });
    return found;
}

/// Fate of a point of a top.
enum class Fate : std::uint8_t { drawn, absent, faulted };

/// Calls visit(begin, end, fate) for the runs of equal fate.
template <class Visit> void for_each_run(const std::vector<Fate>& fates, Visit&& visit) {
    for (std::size_t begin = 0, end = 0; begin < fates.size(); begin = end) {
        while (end < fates.size() && fates[end] == fates[begin])
            ++end;
        visit(begin, end, fates[begin]);
    }
}

/// The part of a trace that can cut layers: without ends that dip by less than 15 degrees, as shear
/// along the free surface does.
Polyline steep_part(const Polyline& trace) {
    constexpr std::size_t stretch = 4; // points
    const auto is_level = [](Point a, Point b) { return a.y - b.y < 0.26 * norm(b - a); };
    std::size_t begin = 0, end = trace.size();
    while (begin + stretch < end && is_level(trace[begin], trace[begin + stretch]))
        ++begin;
    while (begin + stretch < end && is_level(trace[end - 1 - stretch], trace[end - 1]))
        --end;
    if (end - begin <= stretch)
        return {};
    return {trace.begin() + static_cast<std::ptrdiff_t>(begin),
            trace.begin() + static_cast<std::ptrdiff_t>(end)};
}

std::vector<Polyline> cutting_traces(std::span<const Fault> faults) {
    std::vector<Polyline> traces;
    for (const Fault& fault : faults)
        if (Polyline steep = steep_part(fault.trace.points); !steep.empty())
            traces.push_back(std::move(steep));
    return traces;
}

/// Where a line that comes from `from` to `end` meets a trace, straight on, within `reach`; none if
/// it meets none.
std::optional<Point> meets(std::span<const Polyline> traces, Point from, Point end, double reach) {
    if (from == end)
        return std::nullopt;
    const Point step = reach * unit(end - from);
    double first = 2.0;
    for (const Polyline& trace : traces)
        for (std::size_t k = 0; k + 1 < trace.size(); ++k) {
            const Point a = trace[k], edge = trace[k + 1] - a;
            const double slope = cross(step, edge);
            const double along = cross(a - end, edge) / slope; // not finite: they are parallel
            const double on = cross(a - end, step) / slope;
            if (along > 0.0 && along <= 1.0 && on >= 0.0 && on <= 1.0)
                first = std::min(first, along);
        }
    return first > 1.0 ? std::nullopt : std::optional(end + first * step);
}

constexpr std::size_t direction = 5; ///< points that say where an end of a piece goes on to

/// Where a top passes through a fault, from one side to the other, and what is on either side meets
/// it straight on.
void mark_faulted(std::vector<Fate>& fates, const Polyline& top, const Polyline& trace,
                  double reach) {
    std::vector<PolylinePlace> places;
    for (const Point p : top)
        places.push_back(place_on(trace, p));
    const auto is_near = [&](std::size_t k) {
        return !places[k].beyond && std::abs(places[k].distance) < reach;
    };
    for (std::size_t begin = 0, end = 0; begin < top.size(); begin = end) {
        while (end < top.size() && is_near(end) == is_near(begin))
            ++end;
        if (!is_near(begin) || begin <= direction || end + direction >= top.size())
            continue;
        const bool crosses =
            (places[begin - 1].distance > 0.0) != (places[end].distance > 0.0) &&
            meets({&trace, 1}, top[begin - 1 - direction], top[begin - 1], 3.0 * reach) &&
            meets({&trace, 1}, top[end + direction], top[end], 3.0 * reach);
        if (crosses)
            std::fill(fates.begin() + static_cast<std::ptrdiff_t>(begin),
                      fates.begin() + static_cast<std::ptrdiff_t>(end), Fate::faulted);
    }
}

/// Lengthens the end of a piece straight on to a trace, if it meets one.
void reach_fault(Polyline& piece, std::span<const Polyline> traces, double reach) {
    const std::size_t last = piece.size() - 1;
    if (const auto place =
            meets(traces, piece[last - std::min(last, direction)], piece[last], 3.0 * reach))
        piece.push_back(*place);
}

/// A top without what is absent, cut at faults.
std::vector<Polyline> cut(const Polyline& top, std::vector<Fate> fates,
                          std::span<const Polyline> traces, double diameter) {
    const auto fewest = static_cast<std::size_t>(2.0 * shortest); // points half a diameter apart
    std::vector<Fate> joined = fates;
    for_each_run(fates, [&](std::size_t begin, std::size_t end, Fate fate) {
        if (fate == Fate::absent && end - begin < fewest && begin > 0 && end < fates.size())
            std::fill(joined.begin() + static_cast<std::ptrdiff_t>(begin),
                      joined.begin() + static_cast<std::ptrdiff_t>(end), Fate::drawn);
    });
    for (const Polyline& trace : traces)
        mark_faulted(joined, top, trace, fault_reach * diameter);
    std::vector<Polyline> pieces;
    for_each_run(joined, [&](std::size_t begin, std::size_t end, Fate fate) {
        if (fate != Fate::drawn || end - begin < fewest)
            return;
        Polyline piece(top.begin() + static_cast<std::ptrdiff_t>(begin),
                       top.begin() + static_cast<std::ptrdiff_t>(end));
        if (end < top.size() && joined[end] == Fate::faulted)
            reach_fault(piece, traces, fault_reach * diameter);
        if (begin > 0 && joined[begin - 1] == Fate::faulted) {
            std::ranges::reverse(piece);
            reach_fault(piece, traces, fault_reach * diameter);
            std::ranges::reverse(piece);
        }
        pieces.push_back(std::move(piece));
    });
    return pieces;
}

} // namespace

std::vector<Horizon> trace_horizons(const Setting& setting, const RigidBase& base,
                                    const State& state, std::span<const Fault> faults,
                                    const HorizonOptions& options) {
    const ConstDiscColumns d = disc_columns(state);
    const double diameter = 2.0 * state.mean_radius;
    const std::vector<int> strata = strata_of(state, options.pre_rift_layer, setting.boundaries);
    std::map<int, double> travel; // of the first disc, m
    for (std::size_t i = 0; i < strata.size(); ++i)
        travel.emplace(strata[i], d.start_travel[i]);
    const RockSpace room(setting, base, state);
    const OwnerMap map(state, room, fineness * diameter);
    const Shares shares(map, blur * diameter, strata);
    const std::vector<Polyline> traces = cutting_traces(faults);
    std::vector<Horizon> horizons;
    for (const auto& [stratum, at] : travel)
        horizons.push_back(
            {stratum,
             stratum > 0 ? std::optional(setting.calendar.age(Travel(at))) : std::nullopt,
             {},
             {}});
    const auto trace = [&](Horizon& horizon, const GridValues& share, const GridValues* below) {
        horizon.top = tops(share, room, diameter);
        for (const Polyline& top : horizon.top) {
            std::vector<Fate> fates(top.size(), Fate::drawn);
            for (std::size_t k = 0; k < top.size() && below; ++k)
                if (share.at(top[k]) - below->at(top[k]) < least_share)
                    fates[k] = Fate::absent;
            std::ranges::move(cut(top, std::move(fates), traces, diameter),
                              std::back_inserter(horizon.pieces));
        }
    };
    // As many at once as there are threads: a grid is large.
    const auto most = static_cast<std::size_t>(team_size());
    std::vector<GridValues> grids; // the last one of the batch before, then the batch's
    for (std::size_t first = 0; first < horizons.size(); first += most) {
        if (first > 0)
            grids = {std::move(grids.back())};
        const std::size_t known = grids.size(), count = std::min(most, horizons.size() - first);
        grids.resize(known + count);
        for_each_shared(count, [&](std::size_t k) {
            grids[known + k] = shares.up_to(horizons[first + k].stratum);
        });
        for_each_shared(count, [&](std::size_t k) {
            trace(horizons[first + k], grids[known + k],
                  known + k > 0 ? &grids[known + k - 1] : nullptr);
        });
    }
    return horizons;
}

std::vector<Polyline> free_surface(const Setting& setting, const RigidBase& base,
                                   const State& state) {
    const double diameter = 2.0 * state.mean_radius;
    const RockSpace room(setting, base, state);
    const OwnerMap map(state, room, fineness * diameter);
    const Shares shares(map, blur * diameter, strata_of(state, 0.0));
    return tops(shares.up_to(std::numeric_limits<int>::max()), room, diameter);
}

} // namespace listric::measures
