#include "apps/measures/faults/offset/fault_offset.hpp"

#include "apps/measures/faults/strain_ridges.hpp"
#include "apps/support/statistics.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/numbers/gradient.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace listric::measures {

using namespace dem;

namespace {

// Units.
constexpr double fit_reach = 1.9;     ///< of the fit of a slope, as of ShearField
constexpr double block_reach = 8.0;   ///< of the median that is the tilt of a block
constexpr double zone_reach = 3.5;    ///< from a fault, within which rock is none of its blocks
constexpr double step_width = 3.3;    ///< of a sharp step after fit and smoothing
constexpr double ridge_spacing = 2.0; ///< of parallel lines
constexpr double side_height = 1.5;   ///< of bands beside a point, above and below it
constexpr double nearest_band = 0.5;  ///< from the line
constexpr double band_width = 1.75, band_step = 1.25;
constexpr std::size_t bands = 3;

constexpr double sharpness = 0.65;       ///< share of the offset between the innermost bands
constexpr std::size_t fewest_discs = 3;  ///< of a side
constexpr std::size_t shortest_line = 3; ///< points
constexpr double least_active = 10.0;    ///< offset of the last window of an active fault, m

/// Discs and how far each has come up.
struct RisenRock {
    std::vector<double> x, y; ///< now, m
    std::vector<double> rise; ///< m
    std::vector<std::int32_t> stratum;

    void add(Point p, double up, std::int32_t of) {
        x.push_back(p.x);
        y.push_back(p.y);
        rise.push_back(up);
        stratum.push_back(of);
    }
};

/// Since each disc came.
RisenRock risen_in_all(const State& now) {
    const ConstDiscColumns d = disc_columns(now);
    RisenRock rock;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        rock.add({d.x[i], d.y[i]}, d.y[i] - d.start_y[i], d.stratum[i]);
    return rock;
}

/// Since a moment, of discs that were there.
RisenRock risen_since(const DiscPlaces& then, const State& now) {
    const ConstDiscColumns d = disc_columns(now);
    RisenRock rock;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const auto id = static_cast<std::size_t>(d.id[i]);
        if (id < then.row_of.size() && then.row_of[id] >= 0)
            rock.add({d.x[i], d.y[i]}, d.y[i] - then.y[static_cast<std::size_t>(then.row_of[id])],
                     d.stratum[i]);
    }
    return rock;
}

/// Change of rise with x at each disc, by its neighbours of the same stratum. A thin stratum does
/// not tell the change with y, which is small: a weight of 0.15 draws it to 0.
std::vector<double> slopes_of(const RisenRock& rock, double unit) {
    constexpr double level = 0.15;
    const double reach = fit_reach * unit;
    const Cells cells(rock.x, rock.y, reach);
    std::vector<double> slopes(rock.x.size(), 0.0);
    in_pieces(slopes.size(), 512, [&](std::size_t i, std::size_t end) {
        for (; i < end; ++i) {
            GradientFit fit;
            double xx = 0.0;
            cells.for_each_near(rock.x[i], rock.y[i], [&](std::int32_t row) {
                const auto j = static_cast<std::size_t>(row);
                const double dx = rock.x[j] - rock.x[i], dy = rock.y[j] - rock.y[i];
                if (dx * dx + dy * dy > reach * reach || rock.stratum[j] != rock.stratum[i])
                    return;
                fit.add(dx, dy, 0.0, rock.rise[j] - rock.rise[i]);
                xx += dx * dx;
            });
            fit.add(0.0, std::sqrt(level * xx), 0.0, 0.0);
            if (const auto gradient = fit.gradient(1e-3))
                slopes[i] = gradient->yx;
        }
    });
    return slopes;
}

/// Median of the slopes of a stratum around a point, from so many units to its sides on; 0 where
/// there are none. Younger strata have turned less.
double tilt_at(Point p, std::int32_t stratum, const RisenRock& rock, std::span<const double> slopes,
               const Cells& cells, double unit, double from) {
    const double reach = block_reach * unit;
    std::vector<double> near;
    cells.for_each_near(p.x, p.y, [&](std::int32_t row) {
        const auto i = static_cast<std::size_t>(row);
        const double dx = rock.x[i] - p.x, dy = rock.y[i] - p.y;
        if (rock.stratum[i] == stratum && dx * dx + dy * dy < reach * reach &&
            std::abs(dx) >= from * unit)
            near.push_back(slopes[i]);
    });
    return near.empty() ? 0.0 : median(std::move(near));
}

/// Rock with its slopes and tilts.
struct SlopedRock {
    RisenRock rock;
    double unit = 0.0; ///< m
    std::vector<double> slopes;
    Cells cells;

    SlopedRock(RisenRock risen, double unit_of_lengths)
        : rock(std::move(risen)), unit(unit_of_lengths), slopes(slopes_of(rock, unit)),
          cells(rock.x, rock.y, block_reach * unit) {}

    double tilt(Point p, std::int32_t stratum, double from = 0.0) const {
        return tilt_at(p, stratum, rock, slopes, cells, unit, from);
    }
};

/// Rise of discs left and right of a point, by stratum, m.
using Sides = std::map<std::int32_t, std::pair<std::vector<double>, std::vector<double>>>;

/// Step from left to right, of strata that are on both sides; 0 where too few discs are.
double step_between(const Sides& sides) {
    double sum = 0.0, count = 0.0;
    for (const auto& [stratum, side] : sides) {
        const auto least = static_cast<double>(std::min(side.first.size(), side.second.size()));
        if (least < 1.0)
            continue;
        sum += least * (median(side.second) - median(side.first));
        count += least;
    }
    return count < static_cast<double>(fewest_discs) ? 0.0 : sum / count;
}

/// Steps from left to right at a point of a line, by band, m; 0 where there is none.
using Steps = std::array<double, bands>;

Steps steps_at(const Polyline& line, std::size_t k, const SlopedRock& sloped) {
    const RisenRock& rock = sloped.rock;
    const Point p = line[k], way = chord_at(line, k);
    std::map<std::int32_t, double> tilts; // by stratum
    std::array<Sides, bands> sides;
    sloped.cells.for_each_near(p.x, p.y, [&](std::int32_t row) {
        const auto i = static_cast<std::size_t>(row);
        const double dy = rock.y[i] - p.y;
        if (std::abs(dy) > side_height * sloped.unit)
            return;
        const double dx = rock.x[i] - p.x - dy * way.x / way.y;
        if (std::abs(dx) > (nearest_band + (bands - 1) * band_step + band_width) * sloped.unit)
            return;
        const std::int32_t stratum = rock.stratum[i];
        if (!tilts.contains(stratum))
            tilts[stratum] = sloped.tilt(p, stratum, zone_reach);
        const double rise = rock.rise[i] - tilts[stratum] * (rock.x[i] - p.x);
        for (std::size_t band = 0; band < bands; ++band) {
            const double from = nearest_band + static_cast<double>(band) * band_step;
            const double away = std::abs(dx) / sloped.unit - from;
            if (away < 0.0 || away > band_width)
                continue;
            auto& [left, right] = sides[band][stratum];
            (dx < 0.0 ? left : right).push_back(rise);
        }
    });
    Steps steps;
    std::ranges::transform(sides, steps.begin(), step_between);
    return steps;
}

/// Step at each point, as OffsetFault says, in the sense given: 1 up to the right, -1 down. Each
/// band's is the median with those of two points to either side.
std::vector<double> steps_along(const Polyline& line, double sense, const SlopedRock& sloped) {
    std::vector<Steps> raw(line.size());
    for_each_shared(line.size(), [&](std::size_t k) { raw[k] = steps_at(line, k, sloped); });
    std::vector<double> steps(line.size(), 0.0);
    for (std::size_t k = 0; k < raw.size(); ++k) {
        const std::size_t from = k - std::min<std::size_t>(k, 2), to = std::min(k + 3, raw.size());
        Steps smooth{};
        for (std::size_t band = 0; band < bands; ++band) {
            std::vector<double> near;
            for (std::size_t n = from; n < to; ++n)
                near.push_back(sense * raw[n][band]);
            smooth[band] = median(std::move(near));
        }
        const double greatest = std::ranges::max(smooth);
        if (smooth.front() >= sharpness * greatest)
            steps[k] = sense * greatest;
    }
    return steps;
}

/// Pieces of a line that fall by 30 degrees or more, from their upper ends.
std::vector<Polyline> steep_pieces(Polyline line) {
    if (line.front().y < line.back().y)
        std::ranges::reverse(line);
    std::vector<Polyline> pieces(1);
    for (std::size_t k = 0; k < line.size(); ++k)
        if (!is_low_angle({0.0, 0.0}, chord_at(line, k)))
            pieces.back().push_back(line[k]);
        else if (!pieces.back().empty())
            pieces.emplace_back();
    std::erase_if(pieces, [](const Polyline& piece) { return piece.size() < shortest_line; });
    return pieces;
}

/// Lines along which rock comes up (sense 1) or goes down (-1) to the right.
std::vector<Polyline> lines_of(const SlopedRock& sloped, double sense, double least) {
    std::vector<double> excess(sloped.slopes.size());
    in_pieces(excess.size(), 64, [&](std::size_t i, std::size_t end) {
        for (; i < end; ++i) {
            const double tilt =
                sloped.tilt({sloped.rock.x[i], sloped.rock.y[i]}, sloped.rock.stratum[i]);
            excess[i] = std::max(sense * (sloped.slopes[i] - tilt), 0.0);
        }
    });
    const double slope = least / (step_width * sloped.unit);
    std::vector<Polyline> lines;
    for (const Polyline& ridge :
         find_ridges({sloped.rock.x, sloped.rock.y, excess, sloped.unit, 1.0},
                     {0.5 * slope, 0.8 * slope, static_cast<double>(shortest_line) * sloped.unit,
                      ridge_spacing * sloped.unit}))
        for (Polyline& straight : without_kinks(even(ridge, sloped.unit)))
            for (Polyline& piece : steep_pieces(std::move(straight)))
                lines.push_back(std::move(piece));
    return lines;
}

} // namespace

std::vector<OffsetFault> offset_faults(const Setting& setting, const State& now,
                                       const DiscPlaces& before, double least) {
    const double unit = unit_of_faults(2.0 * now.mean_radius, setting.thickness);
    const SlopedRock all(risen_in_all(now), unit), window(risen_since(before, now), unit);
    std::vector<OffsetFault> faults;
    for (const double sense : {1.0, -1.0})
        for (Polyline& line : lines_of(all, sense, least)) {
            std::vector<double> offset = steps_along(line, sense, all);
            const bool is_active =
                std::abs(median(steps_along(line, sense, window))) >= least_active;
            const double side = falls_right(line) ? -1.0 : 1.0; // of the footwall, right or left
            for (double& step : offset)
                step *= side;
            faults.push_back({std::move(line), std::move(offset), is_active});
        }
    return faults;
}

} // namespace listric::measures
