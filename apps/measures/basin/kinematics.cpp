#include "apps/measures/basin/kinematics.hpp"

#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/units.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace listric::measures {

using namespace dem;

namespace {

constexpr double least_shear_angle = -30.0, greatest_shear_angle = 70.0; ///< that are tried
constexpr double nowhere = -std::numeric_limits<double>::infinity();     ///< height of no curve, m

/// Spacing of samples, m: finer where the detachment is shorter than 5 km.
double sample_spacing(const Chain& detachment) {
    return std::min(25.0, length_of(detachment) / 200.0);
}

/// Points along a detachment: of use wherever many curves are compared with it.
struct Samples {
    explicit Samples(const Chain& detachment)
        : spacing(sample_spacing(detachment)),
          deepest(-point_at(detachment, length_of(detachment)).y) {
        const double end = length_of(detachment);
        for (double s = 0.0; s <= end; s += spacing)
            points.push_back(point_at(detachment, s));
    }

    double spacing, deepest; ///< m
    std::vector<Point> points;
};

/// Unit vector along the chain.
Point tangent_at(const Chain& chain, double arc_length) {
    const double h = 1e-3;
    const double end = length_of(chain);
    const double from = std::clamp(arc_length, 0.0, end - h);
    const Point a = point_at(chain, from), b = point_at(chain, from + h);
    const double length = hypotenuse(b.x - a.x, b.y - a.y);
    return {(b.x - a.x) / length, (b.y - a.y) / length};
}

/// Height of the detachment against u = x + depth tan(angle): where a shear plane meets it.
class ShearCoordinate {
public:
    ShearCoordinate(const Samples& detachment, double tangent) {
        for (const Point p : detachment.points)
            // A detachment that rises again is met first where it is met first.
            if (const double u = p.x - p.y * tangent; u_.empty() || u > u_.back()) {
                u_.push_back(u);
                y_.push_back(p.y);
            }
    }

    double height(double u) const {
        if (u <= u_.front())
            return 0.0;
        const auto next = std::ranges::lower_bound(u_, u);
        if (next == u_.end())
            return y_.back();
        const auto k = static_cast<std::size_t>(next - u_.begin());
        const double share = (u - u_[k - 1]) / (u_[k] - u_[k - 1]);
        return y_[k - 1] + share * (y_[k] - y_[k - 1]);
    }

private:
    std::vector<double> u_, y_;
};

/// Height of a curve at every column: its highest point there; -infinity where it is not.
std::vector<double> heights(const std::vector<Point>& curve, std::span<const double> x) {
    std::vector<double> y(x.size(), nowhere);
    for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
        Point a = curve[k], b = curve[k + 1];
        if (b.x < a.x)
            std::swap(a, b);
        const auto first = std::ranges::lower_bound(x, a.x);
        for (auto column = first; column != x.end() && *column <= b.x; ++column) {
            const double share = b.x > a.x ? (*column - a.x) / (b.x - a.x) : 0.0;
            auto& value = y[static_cast<std::size_t>(column - x.begin())];
            value = std::max(value, a.y + share * (b.y - a.y));
        }
    }
    return y;
}

/// What was flat at a depth, as far as it is in the hanging wall; the depth 0: its top.
std::vector<Point> sheared_layer(const Samples& detachment, const ShearCoordinate& fault,
                                 double extension, double tangent, double right, double depth,
                                 double spacing) {
    std::vector<Point> line;
    const double last = depth > 0.0 ? right + 2.0 * depth * std::abs(tangent) + extension
                                    : right + detachment.deepest * tangent;
    for (double u = extension; u <= last; u += spacing) {
        const double before = fault.height(u - extension);
        if (depth > 0.0 && -depth < before)
            continue; // in the footwall
        const double y = fault.height(u) - before - depth, x = u + y * tangent;
        if (x > right && (depth > 0.0 || u > right))
            break;
        line.push_back({x, y});
    }
    return line;
}

std::vector<Point> sheared_top(const Samples& detachment, double extension, double angle,
                               double right) {
    const double tangent = dem::tangent(angle * pi / 180.0);
    return sheared_layer(detachment, ShearCoordinate(detachment, tangent), extension, tangent,
                         right, 0.0, detachment.spacing);
}

/// Root mean square of the heights of a prediction, and of the detachment left of it, less those of
/// the top up to `last`.
double misfit(const Samples& detachment, const std::vector<Point>& prediction,
              std::span<const double> x, std::span<const double> top, double last) {
    if (prediction.empty())
        return 0.0;
    const auto beyond = std::ranges::find_if(detachment.points,
                                             [&](Point p) { return p.x > prediction.front().x; });
    const std::vector<Point> curve(detachment.points.begin(),
                                   beyond == detachment.points.end() ? beyond : beyond + 1);
    std::vector<double> exposed = heights(curve, x), predicted = heights(prediction, x);
    double sum = 0.0, count = 0.0;
    for (std::size_t k = 0; k < x.size() && x[k] <= last; ++k) {
        const double y = std::max(predicted[k], x[k] < prediction.front().x ? exposed[k] : nowhere);
        if (!std::isfinite(y))
            continue;
        sum += (y - top[k]) * (y - top[k]);
        count += 1.0;
    }
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

} // namespace

std::vector<Point> inclined_shear_top(const Chain& detachment, double extension, double angle,
                                      double right) {
    return sheared_top(Samples(detachment), extension, angle, right);
}

ShearedSection sheared_section(const Chain& detachment, double extension, double angle,
                               double right, double spacing, int tops, int layers) {
    const Samples samples(detachment);
    const double tangent = dem::tangent(angle * pi / 180.0);
    const ShearCoordinate fault(samples, tangent);
    spacing = std::max(spacing, samples.spacing);
    ShearedSection section;
    for (int k = tops; k > 0; --k)
        section.tops.push_back(
            sheared_layer(samples, fault, extension * k / tops, tangent, right, 0.0, spacing));
    for (int k = 1; k <= layers; ++k)
        section.layers.push_back(sheared_layer(samples, fault, extension, tangent, right,
                                               samples.deepest * k / (layers + 1), 4.0 * spacing));
    for (const Point p : section.tops.front())
        if (p.y < section.deepest.y)
            section.deepest = p;
    return section;
}

std::vector<Point> normals_top(const Chain& detachment, double extension, double right) {
    const double end = length_of(detachment), spacing = sample_spacing(detachment);
    std::vector<Point> top;
    for (double x = 0.0; x + extension <= right; x += spacing) {
        // The normal through a point of the original surface; at the breakaway the chain is open.
        const auto foot = foot_point(detachment, {x, 0.0});
        const double s = foot ? foot->arc_length : 0.0;
        const double distance = foot ? foot->distance : x;
        if (s + extension > end)
            break;
        const Point p = point_at(detachment, s + extension);
        const Point t = tangent_at(detachment, s + extension);
        top.push_back({p.x - distance * t.y, p.y + distance * t.x});
    }
    return top;
}

double normals_tilt(const Chain& detachment, double extension) {
    const Point a = tangent_at(detachment, 0.0), b = tangent_at(detachment, extension);
    return dem::arc_tangent(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y) * 180.0 / pi;
}

double normals_halfgraben_share(const Chain& detachment, double extension, double right) {
    const std::vector<Point> top = normals_top(detachment, extension, right);
    const double depth = -point_at(detachment, length_of(detachment)).y;
    if (top.size() < 2 || extension <= 0.0 || depth <= 0.0)
        return 0.0;
    // The crest is the first point that is as high as the original surface, or the highest.
    std::size_t crest = 0;
    for (std::size_t k = 0; k < top.size() && top[crest].y < -1e-6 * depth; ++k)
        if (top[k].y > top[crest].y)
            crest = k;
    double area = 0.0;
    for (std::size_t k = 0; k < crest; ++k)
        area -= 0.5 * (top[k].y + top[k + 1].y) * (top[k + 1].x - top[k].x);
    const double spacing = sample_spacing(detachment);
    for (double s = 0.0; s < extension; s += spacing) {
        const Point a = point_at(detachment, s);
        const Point b = point_at(detachment, std::min(s + spacing, extension));
        area -= 0.5 * (a.y + b.y) * (b.x - a.x);
    }
    return area / (extension * depth);
}

double misfit(const Chain& detachment, const std::vector<Point>& prediction,
              std::span<const double> x, std::span<const double> top, double last) {
    return misfit(Samples(detachment), prediction, x, top, last);
}

InclinedShearFit fit_inclined_shear(const Chain& detachment, double extension,
                                    std::span<const double> x, std::span<const double> top) {
    const double right = x.back();
    constexpr double step = 0.5;
    constexpr auto steps =
        static_cast<std::size_t>((greatest_shear_angle - least_shear_angle) / step);
    const Samples samples(detachment);
    std::vector<InclinedShearFit> tried(steps + 1);
    in_pieces(tried.size(), 4, [&](std::size_t k, std::size_t end) {
        for (; k < end; ++k) {
            const double angle = least_shear_angle + step * static_cast<double>(k);
            tried[k] = {angle, misfit(samples, sheared_top(samples, extension, angle, right), x,
                                      top, right)};
        }
    });
    return *std::ranges::min_element(tried, {}, &InclinedShearFit::misfit);
}

double turning_length(const Chain& detachment) {
    constexpr double less = 0.5 * pi / 180.0, steeper = 5.0 * pi / 180.0;
    const auto dip = [](Point tangent) { return dem::arc_tangent(-tangent.y, tangent.x); };
    double at = 0.0, end = 0.0, least = dip(detachment.front().start_tangent);
    const auto take = [&](Point tangent) {
        if (dip(tangent) < least - less) {
            least = dip(tangent);
            end = at;
        }
        return dip(tangent) < least + steeper;
    };
    for (const Segment& s : detachment) {
        if (!take(s.start_tangent))
            break;
        at += s.length;
        if (!take(s.end_tangent))
            break;
    }
    return end;
}

bool head_block_turns(const Chain& detachment, double extension) {
    const double end = turning_length(detachment);
    return end == 0.0 || extension <= end;
}

KinematicPrediction predict_kinematics(const Chain& detachment, double extension,
                                       const Profile& profile) {
    assert(extension > 0.0);
    const double right = profile.x.back();
    const Point cutoff = point_at(detachment, extension);
    KinematicPrediction found;
    const InclinedShearFit shear =
        fit_inclined_shear(detachment, extension, profile.x, profile.pre_rift_top);
    if (shear.angle > least_shear_angle && shear.angle < greatest_shear_angle)
        found.shear = shear;
    if (head_block_turns(detachment, extension))
        found.tilt = normals_tilt(detachment, extension);
    if (extension <= length_of(detachment))
        found.cutoff = Point{cutoff.x, -cutoff.y};
    if (const double share = normals_halfgraben_share(detachment, extension, right);
        share > 0.0 && share < 1.0)
        found.halfgraben_share = share;
    const std::vector<Point> normals = normals_top(detachment, extension, right);
    if (!normals.empty() && extension < detachment.front().length) {
        // Beyond the block that rotates, the hanging wall collapses.
        const double last = cutoff.x + 0.5 * (detachment.front().end.x - cutoff.x);
        found.normals_misfit = misfit(detachment, normals, profile.x, profile.pre_rift_top, last);
    }
    return found;
}

} // namespace listric::measures
