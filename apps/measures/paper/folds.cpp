#include "apps/measures/paper/folds.hpp"

#include "apps/measures/faults/fault_trace.hpp"
#include "apps/measures/faults/main_faults.hpp"
#include "apps/measures/rigid_motion.hpp"
#include "apps/support/statistics.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

constexpr Quantity rollover_count{
    "rollovers", "1", "rollovers",
    "ramp-flat-ramp: maxima with a prominence of 10 degrees of the rotation along x of the "
    "uppermost 4 km of pre-rift rock (columns of 1 km, mean of three)"};
constexpr Quantity syncline_turn{
    "syncline_turn_deg", "deg", "turn of the syncline",
    "ramp-flat-ramp: least rotation between the two largest rollovers"};
constexpr Quantity upper_graben{"upper_graben_prominence_m", "m", "prominence of the upper graben",
                                "ramp-flat-ramp: largest prominence of the basins beyond the first "
                                "up to 3 km beyond the kink. 0: none"};
constexpr Quantity syncline_basin{
    "syncline_basin_prominence_m", "m", "prominence of the syncline's basin",
    "ramp-flat-ramp: largest prominence of the basins further beyond the kink. 0: none"};
constexpr Quantity lower_graben{
    "lower_graben_prominence_m", "m", "prominence of the lower graben",
    "ramp-flat-ramp: second largest prominence of the basins further beyond the kink. 0: none"};

/// Beyond the kink the most prominent basin is the syncline's, the next a collapse graben.
NamedNumbers measure_basins(const RunSoFar& run, double kink) {
    constexpr double beyond_kink = 3e3; // m
    double upper = 0.0, syncline = 0.0, lower = 0.0;
    for (const Depocentre& b : collapse_grabens(find_basins(run.profile))) {
        if (b.x < kink + beyond_kink)
            upper = std::max(upper, b.prominence);
        else if (b.prominence > syncline)
            lower = std::exchange(syncline, b.prominence);
        else
            lower = std::max(lower, b.prominence);
    }
    NamedNumbers numbers;
    add(numbers, upper_graben, upper);
    add(numbers, syncline_basin, syncline);
    add(numbers, lower_graben, lower);
    return numbers;
}

/// Rotation along x.
struct Turns {
    std::vector<double> x;    ///< m
    std::vector<double> turn; ///< degrees, > 0 toward the detachment
};

/// Turns of the uppermost 4 km of pre-rift rock, in columns, the mean of three.
Turns turns_of_top(const RunSoFar& run) {
    constexpr double column = 1e3, thickness = 4e3; // m
    constexpr std::size_t fewest = 20;              // discs
    const ConstDiscColumns& d = run.discs;
    std::map<std::int64_t, RigidMotion> columns;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] == 0 && d.start_y[i] > -thickness)
            columns[static_cast<std::int64_t>(std::floor(d.x[i] / column))].add(
                {d.start_x[i], d.start_y[i]}, {d.x[i], d.y[i]});
    Turns raw;
    for (auto& [number, motion] : columns)
        if (motion.size() >= fewest) {
            motion.fit();
            raw.x.push_back((static_cast<double>(number) + 0.5) * column);
            raw.turn.push_back(motion.angle() * 180.0 / pi);
        }
    Turns smooth = raw;
    for (std::size_t k = 1; k + 1 < raw.turn.size(); ++k)
        smooth.turn[k] = (raw.turn[k - 1] + raw.turn[k] + raw.turn[k + 1]) / 3.0;
    return smooth;
}

/// A rollover turns toward the detachment; a syncline lies where between two of them it turns back.
NamedNumbers measure_rollovers(const RunSoFar& run) {
    constexpr double least = 10.0; // prominence, degrees
    const auto [x, turn] = turns_of_top(run);
    std::vector<Depocentre> maxima = find_depocentres(x, turn, least);
    NamedNumbers numbers;
    add(numbers, rollover_count, static_cast<double>(maxima.size()));
    if (maxima.size() < 2)
        return numbers;
    maxima.resize(2); // the two that turned most
    const auto [left, right] = std::minmax(maxima[0].x, maxima[1].x);
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < x.size(); ++k)
        if (x[k] > left && x[k] < right)
            lowest = std::min(lowest, turn[k]);
    add(numbers, syncline_turn, lowest);
    return numbers;
}

} // namespace

NamedNumbers measure_syncline(const RunSoFar& run, const RampFlatRamp& parts) {
    NamedNumbers numbers = measure_basins(run, point_at(run.detachment, parts.flat_end).x);
    append(numbers, measure_rollovers(run));
    return numbers;
}

std::span<const Quantity> syncline_quantities() {
    static constexpr Quantity all[] = {rollover_count, syncline_turn, upper_graben, syncline_basin,
                                       lower_graben};
    return all;
}

namespace {

constexpr Quantity hinge_start{
    "hinge_start_x_m", "m", "inner edge of the deforming zone, x",
    "position of the inner edge of the deforming zone: tenth percentile, by strain, of the start x "
    "of discs that started 5 to 10 km deep and are strained by 0.05 per 500 m or more, in the last "
    "window"};
constexpr Quantity hinge_step{"hinge_step_m", "m", "way of the deforming zone's inner edge",
                              "distance that the inner edge of the deforming zone has moved toward "
                              "the breakaway: median of `hinge_start_x_m` over the windows from a "
                              "tenth to four tenths of the extension, less its present value"};

constexpr double shallowest = 5e3, deepest = 10e3;  ///< start of the discs looked at, m of depth
constexpr double nearest_share = 0.1;               ///< of the strain, nearest to the breakaway
constexpr double early_from = 0.1, early_to = 0.42; ///< of the extension

/// How far the deformation has moved into the hanging wall: the tenth percentile, by strain, of the
/// start x of discs that are strained as much as a fault is, m.
std::optional<double> hinge(const RunSoFar& run, const ShearField& field) {
    std::vector<std::pair<double, double>> strained; // start x, strain
    double all = 0.0;
    const double least = FaultTraceOptions{}.least_strain_in(field.window);
    for (std::size_t k = 0; k < field.x.size(); ++k) {
        const std::size_t i = run.row(field, k);
        if (const double depth = -run.discs.start_y[i], shear = field.shear(k);
            run.discs.stratum[i] == 0 && depth > shallowest && depth < deepest && shear >= least) {
            strained.emplace_back(run.discs.start_x[i], shear);
            all += shear;
        }
    }
    std::ranges::sort(strained);
    double sum = 0.0;
    for (const auto& [x, shear] : strained)
        if ((sum += shear) >= nearest_share * all)
            return x;
    return std::nullopt;
}

} // namespace

NamedNumbers measure_hinge(const RunSoFar& run) {
    std::vector<double> early;
    for (std::size_t k = 0; k + 1 < run.past.size(); ++k) {
        const Extension end = run.end_of_window(k).extension;
        if (!run.has_come_to(end, early_from * run.extension) || end > early_to * run.extension)
            continue;
        if (const auto x = hinge(run, run.window(k)))
            early.push_back(*x);
    }
    const auto late = run.past.empty() ? std::nullopt : hinge(run, run.last_window);
    if (early.empty() || !late)
        return {};
    NamedNumbers numbers;
    add(numbers, hinge_start, late);
    add(numbers, hinge_step, median(early) - *late);
    return numbers;
}

std::span<const Quantity> hinge_quantities() {
    static constexpr Quantity all[] = {hinge_start, hinge_step};
    return all;
}

namespace {

constexpr double resolved = 3.0; ///< mean diameters between strata that have a value

constexpr Quantity correlation{
    "relief_youth_correlation", "1", "correlation of relief with stratum",
    "rank correlation (Spearman) of the relief of strata across the inner margin of the collapse "
    "graben with their youth, -1 where each younger one has less. Relief: highest top of the "
    "stratum (smoothed over 1 km) between halfgraben and graben less its lowest top in the graben, "
    "known to a disc's diameter. Strata that lie closer than three diameters on the graben's floor "
    "count as one; none for fewer than five"};
constexpr Quantity count{"relief_strata", "1", "strata with a relief",
                         "number of the strata of `relief_youth_correlation`"};
constexpr Quantity antithetic{
    "antithetic_relief_m", "m", "relief at the graben's outer margin",
    "relief of the pre-rift top at the outer margin of the collapse graben, on the antithetic "
    "fault's side: highest top beyond the graben less the lowest in it"};
constexpr Quantity synthetic{
    "synthetic_relief_m", "m", "relief at the graben's inner margin",
    "relief of the pre-rift top at the inner margin of the collapse graben, on the synthetic "
    "fault's side"};
constexpr Quantity ratio{"antithetic_over_synthetic_relief", "1",
                         "relief at the outer over that at the inner margin",
                         "`antithetic_relief_m` over `synthetic_relief_m`"};

/// Columns of the halfgraben's floor, the intervening high and the collapse graben's floor.
struct Columns {
    std::size_t halfgraben, high, graben;
};

std::optional<Columns> find_columns(const Profile& profile) {
    const std::vector<Depocentre> basins = find_basins(profile);
    const auto high =
        find_intervening_high(profile.x, smoothed_depth(profile), depocentre_prominence);
    if (!high)
        return std::nullopt;
    const auto column = [&](double x) {
        return static_cast<std::size_t>(std::ranges::lower_bound(profile.x, x) - profile.x.begin());
    };
    const std::vector<Depocentre> grabens = collapse_grabens(basins);
    return Columns{column(std::ranges::min(basins, {}, &Depocentre::x).x), *high,
                   column(std::ranges::max(grabens, {}, &Depocentre::prominence).x)};
}

/// Tops of a stratum and all below it by column, from the tops of the strata below it.
void raise(std::vector<double>& top, const State& state, int stratum) {
    const ConstDiscColumns d = disc_columns(state);
    const double width = 2.0 * state.mean_radius;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] != stratum || d.x[i] < 0.0)
            continue;
        if (const auto k = static_cast<std::size_t>(d.x[i] / width); k < top.size())
            top[k] = std::max(top[k], d.y[i] + d.radius[i]);
    }
}

} // namespace

std::optional<Relief> find_relief(const State& state, const Profile& profile) {
    const auto columns = find_columns(profile);
    if (!columns)
        return std::nullopt;
    const ConstDiscColumns d = disc_columns(state);
    const double diameter = 2.0 * state.mean_radius;
    const int youngest = std::ranges::max(d.stratum);
    std::vector<double> top = profile.pre_rift_top;
    Relief relief;
    std::optional<double> last; // height of the last resolved stratum on the graben's floor
    for (int stratum = 0; stratum <= youngest; ++stratum) {
        raise(top, state, stratum);
        const std::vector<double> smooth = smoothed(top, diameter);
        if (const double on_floor = smooth[columns->graben];
            last && on_floor - *last < resolved * diameter)
            continue;
        last = smooth[columns->graben];
        const auto at = [&](std::size_t k) {
            return smooth.begin() + static_cast<std::ptrdiff_t>(k);
        };
        const auto floor = std::min_element(at(columns->high), smooth.end());
        relief.inner[stratum] = *std::max_element(at(columns->halfgraben), floor + 1) - *floor;
        if (stratum == 0)
            relief.outer = *std::max_element(floor, smooth.end()) - *floor;
    }
    return relief;
}

NamedNumbers measure_relief(const RunSoFar& run) {
    const auto relief = find_relief(run.now, run.profile);
    if (!relief)
        return {};
    NamedNumbers numbers;
    add(numbers, correlation, throw_age_correlation(relief->inner));
    add(numbers, count, static_cast<double>(relief->inner.size()));
    add(numbers, antithetic, relief->outer);
    add(numbers, synthetic, relief->inner.at(0));
    add(numbers, ratio, relief->outer / relief->inner.at(0));
    return numbers;
}

std::span<const Quantity> relief_quantities() {
    static constexpr Quantity all[] = {correlation, count, antithetic, synthetic, ratio};
    return all;
}

} // namespace listric::measures
