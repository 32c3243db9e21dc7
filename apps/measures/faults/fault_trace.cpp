#include "apps/measures/faults/fault_trace.hpp"

#include "apps/measures/faults/shear_profile.hpp"
#include "apps/measures/faults/strain_ridges.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/events/strain.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace listric::measures {

using namespace dem;

namespace {

/// Whether most of a line lies within a distance of the detachment, m, or below it.
bool along_detachment(const Polyline& points, const Chain& detachment, double distance) {
    if (detachment.empty())
        return false;
    const auto close = std::ranges::count_if(points, [&](Point p) {
        const auto foot = foot_point(detachment, p);
        return foot && foot->distance < distance;
    });
    return 2 * close > static_cast<std::ptrdiff_t>(points.size());
}

/// The upright rectangle around a line.
class Box {
public:
    explicit Box(const Polyline& points) : low_(points.front()), high_(points.front()) {
        for (const Point p : points) {
            low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
            high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
        }
    }

    /// Whether a point may be within a distance of the line, m.
    bool is_near(Point p, double distance) const {
        return p.x >= low_.x - distance && p.x <= high_.x + distance && p.y >= low_.y - distance &&
               p.y <= high_.y + distance;
    }

private:
    Point low_, high_;
};

std::vector<Box> boxes_of(const std::vector<FaultTrace>& traces) {
    std::vector<Box> boxes;
    for (const FaultTrace& trace : traces)
        boxes.emplace_back(trace.points);
    return boxes;
}

/// Strain within 2.5 diameters of a trace over the strain around it out to 10 diameters, other
/// traces left out; the mean of both sides. Where a side is missing, as near the surface, there is
/// nothing that the trace stands out from.
/// @param boxes  around all
double contrast(const ShearField& field, const FaultTrace& trace,
                const std::vector<FaultTrace>& all, const std::vector<Box>& boxes) {
    const double band = 2.5 * field.diameter, reach = 10.0 * field.diameter;
    const Box box(trace.points);
    const auto is_on_one = [&](Point p) {
        for (std::size_t k = 0; k < all.size(); ++k)
            if (boxes[k].is_near(p, band) && std::abs(place_on(all[k].points, p).distance) < band)
                return true;
        return false;
    };
    double sum[3] = {}, count[3] = {}; // on the trace, on its left, on its right
    double seen[3] = {};               // other traces included
    for (std::size_t i = 0; i < field.x.size(); ++i) {
        const Point p{field.x[i], field.y[i]};
        if (!box.is_near(p, reach))
            continue;
        const PolylinePlace place = place_on(trace.points, p);
        if (place.beyond || std::abs(place.distance) > reach)
            continue;
        const bool on = std::abs(place.distance) < band;
        const std::size_t where = on ? 0 : place.distance > 0.0 ? 1 : 2;
        seen[where] += 1.0;
        if (!on && is_on_one(p))
            continue;
        sum[where] += field.shear(i);
        count[where] += 1.0;
    }
    if (count[0] == 0.0)
        return 0.0;
    const double mean = sum[0] / count[0];
    double around = 0.0;
    for (std::size_t side : {1, 2})
        // Complete, it is 1.5 times as large as the band.
        around +=
            0.5 *
            (seen[side] < 0.5 * seen[0] || count[side] == 0.0 ? mean : sum[side] / count[side]);
    return around > 0.0 ? mean / around : 1e300;
}

/// First and last index of the stretches that are true, with gaps of up to `gap`.
std::vector<std::pair<std::size_t, std::size_t>> runs(const std::vector<char>& flags,
                                                      std::size_t gap) {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (std::size_t k = 0; k < flags.size(); ++k) {
        if (!flags[k])
            continue;
        if (found.empty() || k - found.back().second > gap + 1)
            found.emplace_back(k, k);
        found.back().second = k;
    }
    return found;
}

FaultTrace part(const FaultTrace& whole, std::size_t first, std::size_t last) {
    const auto cut = [&](const auto& values) {
        return std::decay_t<decltype(values)>(values.begin() + static_cast<std::ptrdiff_t>(first),
                                              values.begin() + static_cast<std::ptrdiff_t>(last) +
                                                  1);
    };
    return {cut(whole.points), cut(whole.slip), cut(whole.width)};
}

/// A line with what the strain says at each of its points.
struct SurveyedLine {
    FaultTrace trace;
    std::vector<char> is_sound; ///< strained enough, along the line and in the line's sense
};

SurveyedLine survey(Polyline points, const ShearField& field, const Cells& cells,
                    double least_strain, const FaultTraceOptions& options) {
    const std::size_t count = points.size();
    SurveyedLine line{{std::move(points), std::vector<double>(count), std::vector<double>(count)},
                      std::vector<char>(count)};
    FaultTrace& t = line.trace;
    constexpr std::size_t straight = 10; // points, over which a trace's turns are chance
    in_pieces(count, 8, [&](std::size_t k, std::size_t end) {
        for (; k < end; ++k) {
            const ShearProfile profile(field, cells, t.points[k], unit(chord_at(t.points, k)),
                                       options.profile_reach * field.diameter);
            t.slip[k] = profile.slip(unit(chord_at(t.points, k, straight)));
            t.width[k] = profile.width();
            line.is_sound[k] =
                profile.peak() >= least_strain && profile.alignment() >= options.least_alignment;
        }
    });
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k)
        sum += line.is_sound[k] ? t.slip[k] : 0.0;
    for (std::size_t k = 0; k < count; ++k)
        line.is_sound[k] = line.is_sound[k] && t.slip[k] * sum > 0.0;
    return line;
}

/// The sound parts of a line of at least `fewest` points, with gaps of up to five.
void cut(const SurveyedLine& line, std::size_t fewest, std::vector<FaultTrace>& traces) {
    for (const auto& [first, last] : runs(line.is_sound, 5))
        if (last - first + 1 >= fewest)
            traces.push_back(part(line.trace, first, last));
}

} // namespace

std::vector<FaultTrace> trace_faults(const ShearField& field, const Chain& detachment,
                                     const FaultTraceOptions& options) {
    std::vector<FaultTrace> traces;
    if (field.x.empty() || field.window.m <= 0.0)
        return traces;
    const double scale = field.window.m / strain_window;
    const double least = options.least_strain * scale, certain = options.certain_strain * scale;
    std::vector<double> shear(field.x.size());
    for (std::size_t k = 0; k < shear.size(); ++k)
        shear[k] = field.shear(k);
    const std::vector<Polyline> ridges = find_ridges(
        {field.x, field.y, shear, field.diameter, field.discs_across},
        {least, certain, options.least_length * field.diameter, options.spacing * field.diameter});
    const Cells cells(field.x, field.y, 2.0 * ShearProfile::band * field.diameter);
    const auto fewest = static_cast<std::size_t>(options.least_length);
    for (const Polyline& ridge : ridges)
        for (Polyline& points : without_kinks(even(ridge, field.diameter))) {
            if (points.size() < fewest ||
                along_detachment(points, detachment, 2.5 * field.diameter))
                continue;
            if (points.front().y < points.back().y)
                std::ranges::reverse(points);
            cut(survey(std::move(points), field, cells, least, options), fewest, traces);
        }
    const std::vector<Box> boxes = boxes_of(traces);
    std::vector<double> contrasts(traces.size());
    for_each_shared(traces.size(), [&](std::size_t k) {
        contrasts[k] = contrast(field, traces[k], traces, boxes);
    });
    std::vector<FaultTrace> clear;
    for (std::size_t k = 0; k < traces.size(); ++k)
        if (contrasts[k] >= options.least_contrast)
            clear.push_back(std::move(traces[k]));
    std::ranges::stable_sort(clear, std::ranges::greater{},
                             [](const FaultTrace& t) { return t.length(); });
    return clear;
}

} // namespace listric::measures
