#include "apps/model/effects/stage/measures.hpp"

#include "dem/base/just_before.hpp"
#include "dem/columns.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

namespace listric::effects::stage {

using namespace dem;

namespace {

constexpr double no_top = -std::numeric_limits<double>::infinity();

/// Highest points of discs by column.
struct ColumnTops {
    double left = 0.0, width = 1.0; ///< m
    std::vector<double> height;     ///< m; minus infinity: there is none

    double middle(std::size_t k) const { return left + (static_cast<double>(k) + 0.5) * width; }

    ColumnTops(double from, double column, double count)
        : left(from), width(column), height(static_cast<std::size_t>(count), no_top) {}

    void add(double x, double top) {
        const double k = std::floor((x - left) / width);
        if (k >= 0.0 && k < static_cast<double>(height.size())) {
            double& h = height[static_cast<std::size_t>(k)];
            h = std::max(h, top);
        }
    }
};

/// Tops of columns that cover a stretch, the last one perhaps in part.
ColumnTops all_columns(double from, double to, double column) {
    return {from, column, std::max(1.0, std::ceil((to - from) / column))};
}

/// Without the part of a column beside the wall: its highest disc may lie anywhere.
ColumnTops whole_columns(double from, double to, double column) {
    return {from, column, std::floor((to - from) / column)};
}

/// Mean of what is there within half a width of every column.
std::vector<double> means_of_tops(const ColumnTops& tops, double width) {
    const auto reach = static_cast<std::ptrdiff_t>(0.5 * width / tops.width);
    const auto count = static_cast<std::ptrdiff_t>(tops.height.size());
    std::vector<double> means(tops.height.size(), no_top);
    for (std::ptrdiff_t k = 0; k < count; ++k) {
        double sum = 0.0, found = 0.0;
        for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, k - reach);
             j <= std::min(k + reach, count - 1); ++j)
            if (const double h = tops.height[static_cast<std::size_t>(j)]; h > no_top) {
                sum += h;
                found += 1.0;
            }
        if (found > 0.0)
            means[static_cast<std::size_t>(k)] = sum / found;
    }
    return means;
}

} // namespace

std::optional<Travel> turn_of(const Motion& motion) {
    const auto first =
        std::ranges::find_if(motion.stages, [](const MotionStage& one) { return one.slope < 0.0; });
    return first == motion.stages.end() ? std::nullopt : std::optional(first->start);
}

TargetLine regional_of(const Motion& motion, const Target& target, const Calendar& calendar) {
    return target.at(
        calendar.age(turn_of(motion).value_or(Travel(std::numeric_limits<double>::max()))));
}

double area_above_regional(const State& state, const TargetLine& regional) {
    const ConstDiscColumns d = disc_columns(state);
    const auto [left, right] = std::ranges::minmax(d.x);
    ColumnTops tops = all_columns(left, right, 2.0 * state.mean_radius);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        tops.add(d.x[i], d.y[i] + d.radius[i]);
    double area = 0.0;
    for (std::size_t k = 0; k < tops.height.size(); ++k)
        area += std::max(0.0, tops.height[k] - regional.height(tops.middle(k))) * tops.width;
    return area;
}

double graben_relief(const State& state) {
    constexpr double width = 2.5e3; // m
    const ConstDiscColumns d = disc_columns(state);
    const auto [left, right] = std::ranges::minmax(d.x);
    ColumnTops tops = whole_columns(left, right, 2.0 * state.mean_radius);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] == 0)
            tops.add(d.x[i], d.y[i] + d.radius[i]);
    double crest = no_top, relief = 0.0;
    for (const double h : means_of_tops(tops, width)) {
        if (h == no_top)
            continue;
        crest = std::max(crest, h);
        relief = std::max(relief, crest - h);
    }
    return relief;
}

std::optional<double> null_point(const State& state, const Motion& motion,
                                 const TargetLine& regional, Travel turn,
                                 const std::optional<Decompaction>& decompaction) {
    constexpr double from = 200.0, to = 1500.0; // m
    const ConstDiscColumns d = disc_columns(state);
    std::map<std::int32_t, Travel> deposited{{0, Travel()}}; // by stratum; 0: the pre-rift top
    const Travel last = turn + travel_of_cycle(motion, state.clock);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] > 0 && Travel(d.start_travel[i]) <= last)
            deposited[d.stratum[i]] = Travel(d.start_travel[i]);
    const auto porosity = decompaction && state.discs.has(dem::columns::porosity)
                              ? state.discs.get(dem::columns::porosity)
                              : std::span<const double>();
    std::optional<double> before; // height of the next older top, m
    double before_at = 0.0;
    for (const auto& [stratum, travel] : deposited) {
        ColumnTops tops = all_columns(from, to, 2.0 * state.mean_radius);
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (d.stratum[i] <= stratum)
                tops.add(d.x[i], d.y[i] + d.radius[i]);
        double sum = 0.0, level = 0.0, found = 0.0;
        for (std::size_t k = 0; k < tops.height.size(); ++k)
            if (tops.height[k] > no_top) {
                sum += tops.height[k];
                level += regional.height(tops.middle(k));
                found += 1.0;
            }
        if (found == 0.0)
            continue;
        double height = (sum - level) / found;
        if (!porosity.empty()) {
            const double top = sum / found;
            double lost = 0.0; // area of the column, m^2
            for (std::size_t i = 0; i < d.x.size(); ++i) {
                if (d.stratum[i] <= 0 || d.stratum[i] > stratum || d.x[i] < from || d.x[i] > to)
                    continue;
                const double then =
                    decompaction->surface_porosity *
                    dem::exponential(-decompaction->decay * std::max(0.0, top - d.y[i]));
                if (then > porosity[i])
                    lost +=
                        pi * d.radius[i] * d.radius[i] * ((1.0 - porosity[i]) / (1.0 - then) - 1.0);
            }
            height += lost / (1.0 - packing_porosity) / (to - from);
        }
        const double at = motion.position(travel).m;
        if (height >= 0.0 && stratum == 0)
            return at; // all that was extended is taken back
        if (before && *before < 0.0 && height >= 0.0)
            return before_at + (at - before_at) * *before / (*before - height);
        before = height;
        before_at = at;
    }
    return std::nullopt;
}

std::optional<double> reactivated_share(const State& state) {
    if (!state.discs.has(turn_strain) || !state.discs.has(dem::columns::total_strain))
        return std::nullopt;
    const ConstDiscColumns d = disc_columns(state);
    const auto total = state.discs.get(dem::columns::total_strain),
               turn = state.discs.get(turn_strain);
    std::vector<std::size_t> rows;
    double area = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] == 0) {
            rows.push_back(i);
            area += d.radius[i] * d.radius[i];
            sum += (total[i] - turn[i]) * d.radius[i] * d.radius[i];
        }
    if (!(sum > 0.0))
        return std::nullopt;
    std::ranges::stable_sort(rows, std::greater{}, [&](std::size_t i) { return turn[i]; });
    double covered = 0.0, share = 0.0;
    for (const std::size_t i : rows) {
        if (covered >= 0.1 * area)
            break;
        covered += d.radius[i] * d.radius[i];
        share += (total[i] - turn[i]) * d.radius[i] * d.radius[i];
    }
    return share / sum;
}

} // namespace listric::effects::stage
