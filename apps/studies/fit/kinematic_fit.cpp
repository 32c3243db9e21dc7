#include "apps/studies/fit/kinematic_fit.hpp"

#include "apps/studies/fit/simplex_search.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>

namespace listric {

namespace {

using Numbers = std::vector<double>; ///< dip, depth, share of the line, angle

constexpr double shortest_line = 1.0; ///< m
constexpr double flat = 60e3;         ///< m, as of shipped scenes

constexpr double deepest = 60e3; ///< that is tried, m

double deepest_pick(const FitTask& task) {
    double depth = 100.0;
    for (const FitHorizon& horizon : task.horizons)
        for (const double pick : horizon.depth)
            depth = std::max(depth, pick);
    return depth;
}

Numbers least_of(const FitTask& task) { return {20.0, 1.02 * deepest_pick(task), 0.0, -30.0}; }

Numbers greatest_of(const FitTask& task) {
    return {90.0, std::max(deepest, 2.0 * deepest_pick(task)), 0.9, 65.0};
}

ListricShape shape_of(std::span<const double> numbers) {
    return {numbers[0], numbers[1], numbers[2]};
}

/// Down from a place; numbers whose step is 0 stay.
SimplexMinimum descend(const FitTask& task, const Numbers& start, const Numbers& step,
                       int evaluations) {
    const auto misfit = [&](std::span<const double> numbers) {
        return kinematic_misfit(task, shape_of(numbers), numbers[3]);
    };
    return simplex_minimum(misfit, start, step, least_of(task), greatest_of(task), evaluations);
}

Numbers steps_at(const Numbers& place) { return {8.0, 0.1 * place[1], 0.1, 8.0}; }

/// Best of the starts, then downhill from the best few, and once more from where that ends.
SimplexMinimum best_of(const FitTask& task) {
    const Numbers low = least_of(task);
    std::vector<SimplexMinimum> starts;
    for (const double dip : {35.0, 50.0, 65.0, 85.0})
        for (const double depth : {1.1, 1.5, 2.2, 3.5})
            for (const double straight : {0.0, 0.4})
                for (const double angle : {0.0, 20.0, 40.0}) {
                    const Numbers start{dip, depth * low[1], straight, angle};
                    starts.push_back({start, kinematic_misfit(task, shape_of(start), angle)});
                }
    std::ranges::stable_sort(starts, {}, &SimplexMinimum::value);
    starts.resize(4);
    for (SimplexMinimum& start : starts)
        start = descend(task, start.at, steps_at(start.at), 200);
    const SimplexMinimum best = *std::ranges::min_element(starts, {}, &SimplexMinimum::value);
    return descend(task, best.at, steps_at(best.at), 200);
}

/// Values from a lowest to a highest.
std::vector<double> even_values(double low, double high) {
    constexpr int count = 15;
    std::vector<double> values;
    for (int k = 0; k < count; ++k)
        values.push_back(std::lerp(low, high, static_cast<double>(k) / (count - 1)));
    return values;
}

/// From the best to either side, each value's search from where that of its neighbour ended.
FitProfile profile_of(const FitTask& task, const SimplexMinimum& best, std::size_t number) {
    const Numbers at = best.at, low = least_of(task), high = greatest_of(task);
    const bool is_depth = number == 1;
    std::vector<double> values =
        even_values(is_depth ? std::max(low[1], 0.6 * at[1]) : low[number],
                    is_depth ? std::min(high[1], 1.6 * at[1]) : high[number]);
    const auto place = values.insert(std::ranges::upper_bound(values, at[number]), at[number]);
    const std::ptrdiff_t middle = place - values.begin(), end = std::ssize(values);
    FitProfile profile{values, std::vector<double>(values.size(), best.value)};
    for (const std::ptrdiff_t side : {-1, 1}) {
        Numbers from = at;
        for (std::ptrdiff_t k = middle + side; k >= 0 && k < end; k += side) {
            Numbers step = steps_at(from);
            from[number] = values[static_cast<std::size_t>(k)];
            step[number] = 0.0;
            const SimplexMinimum found = descend(task, from, step, 100);
            from = found.at;
            profile.misfit[static_cast<std::size_t>(k)] = found.value;
        }
    }
    return profile;
}

} // namespace

double ListricShape::line_length() const {
    const double length = straight * depth / dem::sine(dip * dem::pi / 180.0);
    return length < shortest_line ? 0.0 : length;
}

double ListricShape::radius() const {
    const double radians = dip * dem::pi / 180.0;
    return (depth - line_length() * dem::sine(radians)) / (1.0 - dem::cosine(radians));
}

dem::DetachmentParameters detachment_of(const ListricShape& shape) {
    dem::DetachmentParameters detachment;
    detachment.start_dip = shape.dip;
    if (shape.line_length() > 0.0)
        detachment.segments.push_back(dem::straight(shape.line_length()));
    detachment.segments.push_back(dem::arc_to_dip(0.0, shape.radius()));
    detachment.segments.push_back(dem::straight(flat));
    return detachment;
}

const std::array<ShapeNumber, 3>& shape_numbers() {
    static constexpr std::array<ShapeNumber, 3> numbers{{
        {"breakaway_dip_deg", "dip at the breakaway", "degrees", &ListricShape::dip, 1.0, 12.0, 5.0,
         false},
        {"depth_m", "depth of the flat", "km", &ListricShape::depth, 1e-3, 0.1, 0.05, true},
        {"straight", "straight share", "", &ListricShape::straight, 1.0, 0.15, 0.1, false},
    }};
    return numbers;
}

FitRange FitProfile::range(double most) const {
    const auto best = static_cast<std::size_t>(std::ranges::min_element(misfit) - misfit.begin());
    // Where the line through two neighbours reaches `most`.
    const auto crossing = [&](std::size_t in, std::size_t out) {
        const double share = (most - misfit[in]) / (misfit[out] - misfit[in]);
        return std::lerp(values[in], values[out], std::clamp(share, 0.0, 1.0));
    };
    FitRange range{values[best], values[best], false, false};
    std::size_t low = best, high = best;
    while (low > 0 && misfit[low - 1] <= most)
        --low;
    while (high + 1 < misfit.size() && misfit[high + 1] <= most)
        ++high;
    range.low_is_end = low == 0;
    range.high_is_end = high + 1 == misfit.size();
    range.low = range.low_is_end ? values[low] : crossing(low, low - 1);
    range.high = range.high_is_end ? values[high] : crossing(high, high + 1);
    return range;
}

double kinematic_misfit(const FitTask& task, const ListricShape& shape, double angle) {
    double right = 0.0, squares = 0.0;
    for (const FitHorizon& horizon : task.horizons)
        for (const double x : horizon.x)
            right = std::max(right, x);
    dem::DetachmentParameters detachment = detachment_of(shape);
    detachment.segments.pop_back(); // shear knows the flat by its depth alone
    const dem::Chain chain = dem::detachment_chain(detachment, 0.0);
    for (const FitHorizon& horizon : task.horizons) {
        const std::vector<double> depth =
            measures::depths_at(measures::predicted_horizon(chain, task.extension, horizon.since,
                                                            angle, right, task.porosity),
                                horizon.x);
        double sum = 0.0;
        for (std::size_t k = 0; k < depth.size(); ++k)
            sum += (depth[k] - horizon.depth[k]) * (depth[k] - horizon.depth[k]);
        squares += sum / static_cast<double>(depth.size());
    }
    return std::sqrt(squares / static_cast<double>(task.horizons.size()));
}

KinematicFit fit_kinematics(const FitTask& task) {
    const SimplexMinimum best = best_of(task);
    KinematicFit fit{shape_of(best.at), best.at[3], best.value, {}};
    for (std::size_t number = 0; number < fit.profiles.size(); ++number)
        fit.profiles[number] = profile_of(task, best, number);
    return fit;
}

} // namespace listric
