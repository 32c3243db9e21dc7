#include "apps/measures/paper/syncline.hpp"

#include "apps/measures/rigid_motion.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
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

} // namespace listric::measures
