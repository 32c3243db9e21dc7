#include "apps/measures/faults/moved_points.hpp"

#include "apps/support/statistics.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/events/strain.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace listric::measures {

using namespace dem;

namespace {

/// Mean displacement of the points 2 to 6 spacings beside a trace, on its footwall's side and the
/// other's; none without a point on either side.
std::optional<Point> movement_across(const MovedPoints& points, const ShearField& field,
                                     const Polyline& trace) {
    Point sum[2];
    double count[2] = {};
    const bool right = falls_right(trace);
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        const PolylinePlace place = place_on(trace, {field.x[i], field.y[i]});
        const double away = std::abs(place.distance) / field.diameter;
        if (place.beyond || away < 2.0 || away > 6.0)
            continue;
        // The footwall is on the right of the downward direction where the fault falls right.
        const std::size_t side = (place.distance > 0.0) == right ? 1 : 0;
        sum[side] = sum[side] + Point{points.dx[i], points.dy[i]};
        count[side] += 1.0;
    }
    if (count[0] == 0.0 || count[1] == 0.0)
        return std::nullopt;
    return (1.0 / count[1]) * sum[1] - (1.0 / count[0]) * sum[0];
}

/// Where values begin and end.
struct Extremes {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;

    void add(double value) {
        least = std::min(least, value);
        greatest = std::max(greatest, value);
    }
    double width() const { return greatest - least; }
};

} // namespace

double spacing_of(const MovedPoints& points) {
    constexpr std::size_t closest = 4;
    assert(points.x.size() > closest);
    const auto [left, right] = std::ranges::minmax(points.x);
    const auto [bottom, top] = std::ranges::minmax(points.y);
    const double width = right - left, height = top - bottom;
    const auto count = static_cast<double>(points.x.size());
    // Points on a line have no area.
    const double guess =
        std::max(std::sqrt(width * height / count), std::max(width, height) / count);
    if (guess == 0.0)
        return 0.0;
    const Cells cells(points.x, points.y, 3.0 * guess);
    std::vector<double> spacings;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        std::vector<double> distances;
        cells.for_each_near(points.x[i], points.y[i], [&](std::int32_t row) {
            const auto j = static_cast<std::size_t>(row);
            if (j != i)
                distances.push_back(
                    hypotenuse(points.x[j] - points.x[i], points.y[j] - points.y[i]));
        });
        if (distances.size() < closest)
            continue;
        std::ranges::nth_element(distances, distances.begin() + closest - 1);
        distances.resize(closest);
        spacings.push_back(spread(distances).mean);
    }
    return spacings.empty() ? guess : median(std::move(spacings));
}

std::string objection_to(const MovedPoints& points) {
    constexpr double farthest = 1e9; // m
    const auto is_far = [](double value) { return !(std::abs(value) <= farthest); };
    for (const auto* values : {&points.x, &points.y, &points.dx, &points.dy})
        if (std::ranges::any_of(*values, is_far))
            return "has a point that is, or has moved, further than 1e9 m";
    const double spacing = spacing_of(points);
    Extremes x, y;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        x.add(points.x[i] + points.dx[i]);
        y.add(points.y[i] + points.dy[i]);
    }
    const double places = (x.width() / spacing + 1.0) * (y.width() / spacing + 1.0);
    if (spacing == 0.0 || places <= 100.0 * static_cast<double>(points.x.size()) + 1e6)
        return "";
    std::ostringstream text;
    text << std::setprecision(3) << "has " << points.x.size() << " points, most of them " << spacing
         << " m from their neighbours, but all over " << x.width() / 1e3 << " by "
         << y.width() / 1e3 << " km, where " << places
         << " would have room; leave out those that are far from the others";
    return text.str();
}

ShearField shear_field(const MovedPoints& points) {
    ShearField field;
    field.diameter = spacing_of(points);
    field.window = Extension(strain_window);
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        field.x.push_back(points.x[i] + points.dx[i]);
        field.y.push_back(points.y[i] + points.dy[i]);
        field.id.push_back(static_cast<std::int64_t>(i));
    }
    if (field.diameter > 0.0)
        fit_gradients(field, points.x, points.y);
    return field;
}

std::vector<TracedFault> trace_faults(const MovedPoints& points, const FaultTraceOptions& options) {
    constexpr double vertical = 88.0; // degrees: a dip is known to two
    const ShearField field = shear_field(points);
    std::vector<TracedFault> faults;
    if (!(field.diameter > 0.0))
        return faults;
    for (FaultTrace& trace : trace_faults(field, Chain{}, options)) {
        TracedFault f;
        const double slip = median(trace.slip);
        f.dip = dip_of(trace.points);
        // Which side of a vertical fault is above it is chance; the side that sinks is.
        f.normal = f.dip > vertical || (slip > 0.0) == falls_right(trace.points);
        f.slip = std::abs(slip);
        f.width = median(trace.width) / field.diameter;
        if (const auto moves = movement_across(points, field, trace.points))
            f.throw_down = f.dip > vertical ? std::abs(moves->y) : -moves->y;
        f.trace = std::move(trace);
        faults.push_back(std::move(f));
    }
    return faults;
}

} // namespace listric::measures
