#include "apps/measures/fault_trace.hpp"

#include "dem/cells.hpp"
#include "dem/units.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace listric {

using namespace dem;

namespace {

Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
Point operator*(double f, Point a) { return {f * a.x, f * a.y}; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
double norm(Point a) { return std::hypot(a.x, a.y); }
Point unit(Point a) { return (1.0 / norm(a)) * a; }

/// The shear strain smoothed by a Gaussian of one mean diameter, on a square grid of half a
/// diameter.
class SmoothStrain {
public:
    explicit SmoothStrain(const ShearField& field) : step_(0.5 * field.diameter) {
        const auto [left, right] = std::ranges::minmax(field.x);
        const auto [bottom, top] = std::ranges::minmax(field.y);
        left_ = left - 4.0 * step_;
        bottom_ = bottom - 4.0 * step_;
        columns_ = static_cast<std::ptrdiff_t>((right - left_) / step_) + 6;
        rows_ = static_cast<std::ptrdiff_t>((top - bottom_) / step_) + 6;
        std::vector<double> amount(static_cast<std::size_t>(columns_ * rows_), 0.0), weight(amount);
        for (std::size_t k = 0; k < field.x.size(); ++k) {
            // Bilinear shares of a disc, then two one-dimensional passes.
            const double u = (field.x[k] - left_) / step_, v = (field.y[k] - bottom_) / step_;
            const auto c = static_cast<std::ptrdiff_t>(u), r = static_cast<std::ptrdiff_t>(v);
            const double fu = u - static_cast<double>(c), fv = v - static_cast<double>(r);
            const double strain = field.shear(k);
            for (std::ptrdiff_t dc : {0, 1})
                for (std::ptrdiff_t dr : {0, 1}) {
                    const double share = (dc ? fu : 1.0 - fu) * (dr ? fv : 1.0 - fv);
                    amount[at(c + dc, r + dr)] += share * strain;
                    weight[at(c + dc, r + dr)] += share;
                }
        }
        blur(amount);
        blur(weight);
        // About 0.27 discs per grid cell; half of that is at an edge.
        values_.assign(amount.size(), 0.0);
        for (std::size_t k = 0; k < amount.size(); ++k)
            if (weight[k] > 0.15)
                values_[k] = amount[k] / weight[k];
    }

    std::ptrdiff_t columns() const { return columns_; }
    std::ptrdiff_t rows() const { return rows_; }
    double value(std::ptrdiff_t c, std::ptrdiff_t r) const { return values_[at(c, r)]; }
    Point place(std::ptrdiff_t c, std::ptrdiff_t r) const {
        return {left_ + static_cast<double>(c) * step_, bottom_ + static_cast<double>(r) * step_};
    }

    double value(Point p) const {
        const double u = (p.x - left_) / step_, v = (p.y - bottom_) / step_;
        const auto c = static_cast<std::ptrdiff_t>(std::floor(u));
        const auto r = static_cast<std::ptrdiff_t>(std::floor(v));
        if (c < 0 || r < 0 || c + 1 >= columns_ || r + 1 >= rows_)
            return 0.0;
        const double fu = u - static_cast<double>(c), fv = v - static_cast<double>(r);
        return (1.0 - fu) * ((1.0 - fv) * value(c, r) + fv * value(c, r + 1)) +
               fu * ((1.0 - fv) * value(c + 1, r) + fv * value(c + 1, r + 1));
    }

    /// Direction in which the strain changes least around a point: along the ridge.
    Point ridge_direction(Point p) const {
        const double h = 1.5 * step_;
        const double f = value(p);
        const double xx = value(p + Point{h, 0.0}) + value(p - Point{h, 0.0}) - 2.0 * f;
        const double yy = value(p + Point{0.0, h}) + value(p - Point{0.0, h}) - 2.0 * f;
        const double xy = 0.25 * (value(p + Point{h, h}) + value(p - Point{h, h}) -
                                  value(p + Point{h, -h}) - value(p + Point{-h, h}));
        // Eigenvector of the Hessian's larger eigenvalue.
        const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
        return {std::cos(angle), std::sin(angle)};
    }

    double step() const { return step_; }

private:
    std::size_t at(std::ptrdiff_t c, std::ptrdiff_t r) const {
        return static_cast<std::size_t>(c * rows_ + r);
    }

    void blur(std::vector<double>& values) const {
        constexpr std::ptrdiff_t reach = 6;
        constexpr double deviation = 2.0; // grid steps
        double kernel[reach + 1], sum = 0.0;
        for (std::ptrdiff_t k = 0; k <= reach; ++k) {
            kernel[k] = std::exp(-0.5 * static_cast<double>(k * k) / (deviation * deviation));
            sum += (k ? 2.0 : 1.0) * kernel[k];
        }
        for (double& k : kernel)
            k /= sum;
        std::vector<double> other(values.size(), 0.0);
        const auto pass = [&](const std::vector<double>& from, std::vector<double>& to,
                              bool along_columns) {
            for (std::ptrdiff_t c = 0; c < columns_; ++c)
                for (std::ptrdiff_t r = 0; r < rows_; ++r) {
                    double value = 0.0;
                    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
                        const std::ptrdiff_t cc = along_columns ? c + k : c;
                        const std::ptrdiff_t rr = along_columns ? r : r + k;
                        if (cc >= 0 && cc < columns_ && rr >= 0 && rr < rows_)
                            value += kernel[std::abs(k)] * from[at(cc, rr)];
                    }
                    to[at(c, r)] = value;
                }
        };
        pass(values, other, true);
        pass(other, values, false);
    }

    double step_, left_ = 0.0, bottom_ = 0.0;
    std::ptrdiff_t columns_ = 0, rows_ = 0;
    std::vector<double> values_;
};

/// Distance of a point from the nearest point of the lines, and that line's direction there.
struct Nearby {
    double distance = 1e300;
    Point direction;
};

Nearby nearest_line(const std::vector<std::vector<Point>>& lines, Point p) {
    Nearby best;
    for (const auto& line : lines)
        for (std::size_t k = 0; k < line.size(); ++k)
            if (const double distance = norm(p - line[k]); distance < best.distance)
                best = {distance, line[std::min(k + 1, line.size() - 1)] - line[k > 0 ? k - 1 : 0]};
    return best;
}

/// Follows a ridge from `start` along `direction` until it ends, turns sharply or joins a line
/// found before; lines that cross at a large angle are crossed. `start` is not repeated.
std::vector<Point> follow(const SmoothStrain& strain, Point start, Point direction,
                          double least_strain, double spacing,
                          const std::vector<std::vector<Point>>& lines) {
    const double step = strain.step();
    constexpr std::size_t most = 4000;
    const int longest_crossing = 4 + static_cast<int>(3.0 * spacing / step);
    std::vector<Point> line;
    std::vector<Point> behind(10, direction); // directions of the last steps
    Point p = start;
    int crossing = 0;
    for (std::size_t n = 0; n < most; ++n) {
        Point mean{0.0, 0.0};
        for (Point b : behind)
            mean = mean + b;
        mean = unit(mean);
        Point ahead = mean;
        if (crossing == 0) {
            Point along = strain.ridge_direction(p);
            if (dot(along, mean) < 0.0)
                along = -1.0 * along;
            if (dot(along, mean) > 0.5)
                ahead = unit(mean + along);
        }
        Point next = p + step * ahead;
        const Point across{-ahead.y, ahead.x};
        // To the crest: the largest value within 0.6 of a step to either side.
        double best = -1.0, shift = 0.0;
        for (int k = -3; k <= 3; ++k)
            if (const double f = strain.value(next + 0.2 * k * step * across);
                f > best * (1.0 + 1e-9)) {
                best = f;
                shift = 0.2 * k * step;
            }
        const Nearby other = nearest_line(lines, next);
        const bool occupied = other.distance < spacing;
        if (occupied) {
            const Point d = unit(other.direction);
            if (std::abs(dot(d, ahead)) > 0.85 || ++crossing > longest_crossing)
                break; // joins it
        } else {
            crossing = 0;
            next = next + shift * across;
        }
        if (best < least_strain)
            break;
        const Point moved = unit(next - p);
        if (dot(moved, mean) < 0.6)
            break;
        behind.erase(behind.begin());
        behind.push_back(moved);
        p = next;
        line.push_back(p);
        // Came back to itself.
        for (std::size_t k = 0; k + 12 < line.size(); ++k)
            if (norm(line[k] - p) < 2.0 * step)
                return line;
    }
    if (crossing > 0)
        line.resize(line.size() - std::min(line.size(), static_cast<std::size_t>(crossing)));
    return line;
}

/// Points one diameter apart, each the mean of its neighbourhood so that the grid does not show.
std::vector<Point> even(const std::vector<Point>& raw, double spacing) {
    std::vector<Point> smooth(raw.size());
    for (std::size_t k = 0; k < raw.size(); ++k) {
        const std::size_t reach = std::min({std::size_t{5}, k, raw.size() - 1 - k});
        Point sum;
        for (std::size_t m = k - reach; m <= k + reach; ++m)
            sum = sum + raw[m];
        smooth[k] = (1.0 / static_cast<double>(2 * reach + 1)) * sum;
    }
    std::vector<Point> points{smooth.front()};
    double since = 0.0;
    for (std::size_t k = 1; k < smooth.size(); ++k) {
        Point from = smooth[k - 1];
        double left = norm(smooth[k] - from);
        while (since + left >= spacing) {
            from = from + ((spacing - since) / left) * (smooth[k] - from);
            points.push_back(from);
            left = norm(smooth[k] - from);
            since = 0.0;
        }
        since += left;
    }
    return points;
}

/// Direction of a polyline at a point, over three points to either side.
Point direction_at(const std::vector<Point>& points, std::size_t k) {
    return unit(points[std::min(k + 3, points.size() - 1)] - points[k > 3 ? k - 3 : 0]);
}

/// Shear resolved along the trace, across it: the mean of the discs within three diameters along.
class ShearProfile {
public:
    ShearProfile(const ShearField& field, const Cells& cells, Point p, Point t, double reach)
        : step_(0.5 * field.diameter), half_(static_cast<std::ptrdiff_t>(reach / step_)) {
        const auto size = static_cast<std::size_t>(2 * half_ + 1);
        std::vector<double> weight(size, 0.0), stretch(size, 0.0), turn(size, 0.0);
        values_.assign(size, 0.0);
        const double band = 3.0 * field.diameter;
        const Point n{-t.y, t.x};
        std::vector<std::int32_t> seen;
        // The cells are two bands wide.
        for (double s = -reach; s <= reach + band; s += 2.0 * band)
            cells.for_each_near(p.x + s * n.x, p.y + s * n.y,
                                [&](std::int32_t row) { seen.push_back(row); });
        std::ranges::sort(seen);
        seen.erase(std::ranges::unique(seen).begin(), seen.end());
        for (std::int32_t row : seen) {
            const auto k = static_cast<std::size_t>(row);
            const Point r = Point{field.x[k], field.y[k]} - p;
            if (std::abs(dot(r, t)) > band)
                continue;
            const double place = dot(r, n) / step_ + static_cast<double>(half_);
            // A triangle of 0.75 diameters to either side.
            const auto low = static_cast<std::ptrdiff_t>(std::ceil(place - 1.5));
            for (std::ptrdiff_t b = low; static_cast<double>(b) < place + 1.5; ++b) {
                if (b < 0 || b > 2 * half_)
                    continue;
                const double share = 1.0 - std::abs(static_cast<double>(b) - place) / 1.5;
                stretch[static_cast<std::size_t>(b)] += share * (field.xx[k] - field.yy[k]);
                turn[static_cast<std::size_t>(b)] += share * (field.xy[k] + field.yx[k]);
                weight[static_cast<std::size_t>(b)] += share;
            }
        }
        for (std::size_t b = 0; b < size; ++b)
            if (weight[b] > 0.0) {
                stretch[b] /= weight[b];
                turn[b] /= weight[b];
                values_[b] = turn[b] * (t.x * t.x - t.y * t.y) - 2.0 * t.x * t.y * stretch[b];
            }
        sign_ = 1.0;
        for (std::ptrdiff_t b = -3; b <= 3; ++b)
            if (const double v = values_[static_cast<std::size_t>(half_ + b)];
                std::abs(v) > peak_value_) {
                peak_value_ = std::abs(v);
                sign_ = v < 0.0 ? -1.0 : 1.0;
                peak_ = half_ + b;
            }
        const auto peak = static_cast<std::size_t>(peak_);
        const double largest = std::hypot(stretch[peak], turn[peak]);
        alignment_ = largest > 0.0 ? peak_value_ / largest : 0.0;
    }

    double peak() const { return peak_value_; }

    /// Shear along the trace over the largest shear of any plane: 1 where the trace is that plane.
    double alignment() const { return alignment_; }

    /// Full width at half maximum, m.
    double width() const { return step_ * (side(0.5, 1) + side(0.5, -1)); }

    /// Displacement of the left side relative to the right, along the trace, m: the profile's
    /// integral out to a tenth of the peak or to where another zone begins.
    double slip() const {
        double sum = value(peak_);
        for (std::ptrdiff_t step : {1, -1})
            for (std::ptrdiff_t b = peak_ + step; b >= 0 && b <= 2 * half_; b += step) {
                const double v = value(b);
                if (v < 0.1 * peak_value_ || (v < 0.5 * peak_value_ && v > 1.1 * value(b - step)))
                    break;
                sum += v;
            }
        return sign_ * sum * step_;
    }

private:
    double value(std::ptrdiff_t b) const { return sign_ * values_[static_cast<std::size_t>(b)]; }

    /// Steps from the peak to where the profile falls below a share of it.
    double side(double share, std::ptrdiff_t step) const {
        const double level = share * peak_value_;
        for (std::ptrdiff_t b = peak_ + step; b >= 0 && b <= 2 * half_; b += step)
            if (const double v = value(b); v < level) {
                const double before = value(b - step);
                return static_cast<double>(std::abs(b - peak_)) - (level - v) / (before - v);
            }
        return static_cast<double>(step > 0 ? 2 * half_ - peak_ : peak_);
    }

    double step_;
    std::ptrdiff_t half_, peak_ = 0;
    double peak_value_ = 0.0, sign_ = 1.0, alignment_ = 0.0;
    std::vector<double> values_;
};

bool along_detachment(const std::vector<Point>& points, const Chain& detachment, double distance) {
    if (detachment.empty())
        return false;
    const auto close = std::ranges::count_if(points, [&](Point p) {
        const auto foot = foot_point(detachment, p);
        return foot && foot->distance < distance;
    });
    return 2 * close > static_cast<std::ptrdiff_t>(points.size());
}

/// Strain within 2.5 diameters of a trace over that of its surroundings out to 10 diameters, other
/// traces left out; the mean of both sides. Where a side is missing, as near the surface, there is
/// nothing that the trace stands out from.
double contrast(const ShearField& field, const FaultTrace& trace,
                const std::vector<FaultTrace>& all) {
    const double band = 2.5 * field.diameter, reach = 10.0 * field.diameter;
    Point low = trace.points.front(), high = low;
    for (Point p : trace.points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    double sum[3] = {}, count[3] = {}; // on the trace, on its left, on its right
    double seen[3] = {};               // other traces included
    for (std::size_t i = 0; i < field.x.size(); ++i) {
        const Point p{field.x[i], field.y[i]};
        if (p.x < low.x - reach || p.x > high.x + reach || p.y < low.y - reach ||
            p.y > high.y + reach)
            continue;
        const PolylinePlace place = place_on(trace.points, p);
        if (place.beyond || std::abs(place.distance) > reach)
            continue;
        const bool on = std::abs(place.distance) < band;
        const std::size_t where = on ? 0 : place.distance > 0.0 ? 1 : 2;
        seen[where] += 1.0;
        if (!on && std::ranges::any_of(all, [&](const FaultTrace& other) {
                return std::abs(place_on(other.points, p).distance) < band;
            }))
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

/// Joins lines that go on in each other beyond a gap of up to 10 diameters or a side step of up to
/// five.
void join(std::vector<std::vector<Point>>& lines, double diameter) {
    const auto end_direction = [&](const std::vector<Point>& line) {
        const std::size_t back = std::min<std::size_t>(line.size() - 1, 16);
        return unit(line.back() - line[line.size() - 1 - back]);
    };
    const double cosine = std::cos(30.0 * pi / 180.0);
    for (bool joined = true; joined;) {
        joined = false;
        for (std::size_t a = 0; a < lines.size() && !joined; ++a)
            for (std::size_t b = a + 1; b < lines.size() && !joined; ++b)
                for (int turns = 0; turns < 4 && !joined; ++turns) {
                    // All pairings of ends: the end of a with the start of b.
                    std::ranges::reverse(turns % 2 ? lines[a] : lines[b]);
                    const Point gap = lines[b].front() - lines[a].back();
                    std::vector<Point> backward(lines[b].rbegin(), lines[b].rend());
                    const Point out = end_direction(lines[a]);
                    const Point in = -1.0 * end_direction(backward);
                    const double along = dot(gap, out), across = std::abs(cross(out, gap));
                    const bool straight =
                        along > 0.0 && across < std::max(2.0 * diameter, 0.58 * along);
                    const bool stepped = along > -4.0 * diameter && across < 5.0 * diameter;
                    if (norm(gap) > 10.0 * diameter || dot(out, in) < cosine ||
                        !(straight || stepped))
                        continue;
                    if (!straight) {
                        // A side step: it is bridged over ten diameters, and what overlaps goes.
                        const double spare = std::max(0.0, 10.0 * diameter - along);
                        const auto points = static_cast<std::size_t>(spare / diameter);
                        if (lines[a].size() < 2 * points + 8 || lines[b].size() < 2 * points + 8)
                            continue;
                        lines[a].resize(lines[a].size() - points);
                        lines[b].erase(lines[b].begin(),
                                       lines[b].begin() + static_cast<std::ptrdiff_t>(points));
                    }
                    const Point bridge = lines[b].front() - lines[a].back();
                    const double length = norm(bridge);
                    const auto steps = static_cast<int>(length / (0.5 * diameter));
                    for (int k = 1; k <= steps; ++k)
                        lines[a].push_back(lines[b].front() -
                                           (1.0 - static_cast<double>(k) / (steps + 1)) * bridge);
                    lines[a].insert(lines[a].end(), lines[b].begin(), lines[b].end());
                    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(b));
                    joined = true;
                }
    }
}

/// Pieces between points where the line turns by more than 40 degrees within ten diameters.
std::vector<std::vector<Point>> without_kinks(const std::vector<Point>& points) {
    std::vector<std::vector<Point>> pieces;
    std::size_t begin = 0;
    const auto turn = [&](std::size_t k) {
        const std::size_t reach = std::min({std::size_t{10}, k, points.size() - 1 - k});
        if (reach < 3)
            return 1.0;
        return dot(unit(points[k] - points[k - reach]), unit(points[k + reach] - points[k]));
    };
    for (std::size_t k = 1; k + 1 < points.size(); ++k)
        if (turn(k) < std::cos(40.0 * pi / 180.0) && turn(k) <= turn(k - 1) &&
            turn(k) < turn(k + 1)) {
            pieces.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(begin),
                                points.begin() + static_cast<std::ptrdiff_t>(k) + 1);
            begin = k;
        }
    pieces.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(begin), points.end());
    return pieces;
}

/// First and last index of the stretches that are true, with gaps of up to `gap`.
std::vector<std::pair<std::size_t, std::size_t>> runs(const std::vector<bool>& flags,
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

} // namespace

double FaultTrace::length() const {
    double sum = 0.0;
    for (std::size_t k = 1; k < points.size(); ++k)
        sum += norm(points[k] - points[k - 1]);
    return sum;
}

double dip_of(const std::vector<Point>& points) {
    Point mean;
    for (Point p : points)
        mean = mean + p;
    mean = (1.0 / static_cast<double>(points.size())) * mean;
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (Point p : points) {
        xx += (p.x - mean.x) * (p.x - mean.x);
        xy += (p.x - mean.x) * (p.y - mean.y);
        yy += (p.y - mean.y) * (p.y - mean.y);
    }
    return std::abs(0.5 * std::atan2(2.0 * xy, xx - yy)) * 180.0 / pi;
}

double curvature_of(const std::vector<Point>& points) {
    if (points.size() < 3)
        return 0.0;
    // Offset above the chord, taken to the right so that up is left, as a parabola.
    Point a = points.front(), b = points.back();
    if (b.x < a.x)
        std::swap(a, b);
    const Point t = unit(b - a);
    double sum[5] = {}, moment[3] = {};
    const double half = 0.5 * norm(b - a);
    for (Point p : points) {
        const double s = dot(p - a, t) / half - 1.0, w = cross(t, p - a);
        double power = 1.0;
        for (int k = 0; k < 5; ++k, power *= s) {
            sum[k] += power;
            if (k < 3)
                moment[k] += power * w;
        }
    }
    // Normal equations of w = c0 + c1 s + c2 s^2, by Cramer's rule.
    const auto determinant = [](double a0, double a1, double a2, double b0, double b1, double b2,
                                double c0, double c1, double c2) {
        return a0 * (b1 * c2 - b2 * c1) - a1 * (b0 * c2 - b2 * c0) + a2 * (b0 * c1 - b1 * c0);
    };
    const double all =
        determinant(sum[0], sum[1], sum[2], sum[1], sum[2], sum[3], sum[2], sum[3], sum[4]);
    const double c2 = determinant(sum[0], sum[1], moment[0], sum[1], sum[2], moment[1], sum[2],
                                  sum[3], moment[2]) /
                      all;
    return -2.0 * c2 / (half * half);
}

PolylinePlace place_on(const std::vector<Point>& points, Point p) {
    PolylinePlace best{1e300, 0.0, true};
    double along = 0.0;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const Point edge = points[k + 1] - points[k];
        const double length = norm(edge);
        const double raw = dot(p - points[k], edge) / length;
        const double s = std::clamp(raw, 0.0, length);
        const Point foot = points[k] + (s / length) * edge;
        if (const double distance = norm(p - foot); distance < std::abs(best.distance)) {
            const bool end = (k == 0 && raw < 0.0) || (k + 2 == points.size() && raw > length);
            best = {cross(edge, p - points[k]) < 0.0 ? -distance : distance, along + s, end};
        }
        along += length;
    }
    return best;
}

std::vector<FaultTrace> trace_faults(const ShearField& field, const Chain& detachment,
                                     const FaultTraceOptions& options) {
    std::vector<FaultTrace> traces;
    if (field.x.empty() || field.window <= 0.0)
        return traces;
    const double scale = field.window / 500.0;
    const double least = options.least_strain * scale, certain = options.certain_strain * scale;
    const double spacing = options.spacing * field.diameter;
    const SmoothStrain strain(field);

    std::vector<std::pair<double, Point>> seeds;
    for (std::ptrdiff_t c = 1; c + 1 < strain.columns(); ++c)
        for (std::ptrdiff_t r = 1; r + 1 < strain.rows(); ++r) {
            const double f = strain.value(c, r);
            if (f < certain)
                continue;
            // On a crest: no neighbour on opposite sides is higher in some direction.
            const auto crest = [&](std::ptrdiff_t dc, std::ptrdiff_t dr) {
                return f >= strain.value(c + dc, r + dr) && f >= strain.value(c - dc, r - dr);
            };
            if (crest(1, 0) || crest(0, 1) || crest(1, 1) || crest(1, -1))
                seeds.emplace_back(f, strain.place(c, r));
        }
    std::ranges::stable_sort(seeds, std::ranges::greater{}, [](const auto& s) { return s.first; });

    std::vector<std::vector<Point>> lines;
    std::vector<Point> tried;
    for (const auto& [f, seed] : seeds) {
        if (nearest_line(lines, seed).distance < spacing ||
            std::ranges::any_of(tried,
                                [&](Point t) { return norm(t - seed) < 2.0 * strain.step(); }))
            continue;
        const Point direction = strain.ridge_direction(seed);
        std::vector<Point> line = follow(strain, seed, -1.0 * direction, least, spacing, lines);
        std::ranges::reverse(line);
        line.push_back(seed);
        const std::vector<Point> onward = follow(strain, seed, direction, least, spacing, lines);
        line.insert(line.end(), onward.begin(), onward.end());
        double length = 0.0;
        for (std::size_t k = 1; k < line.size(); ++k)
            length += norm(line[k] - line[k - 1]);
        if (length < options.least_length * field.diameter) {
            tried.push_back(seed);
            continue;
        }
        lines.push_back(std::move(line));
    }

    join(lines, field.diameter);
    const Cells cells(field.x, field.y, 6.0 * field.diameter);
    const auto fewest = static_cast<std::size_t>(options.least_length);
    for (const auto& line : lines)
        for (std::vector<Point>& points : without_kinks(even(line, field.diameter))) {
            if (points.size() < fewest ||
                along_detachment(points, detachment, 2.5 * field.diameter))
                continue;
            if (points.front().y < points.back().y)
                std::ranges::reverse(points);
            FaultTrace whole{std::move(points), {}, {}};
            std::vector<bool> sound;
            double sum = 0.0;
            for (std::size_t k = 0; k < whole.points.size(); ++k) {
                const ShearProfile profile(field, cells, whole.points[k],
                                           direction_at(whole.points, k),
                                           options.profile_reach * field.diameter);
                whole.slip.push_back(profile.slip());
                whole.width.push_back(profile.width());
                sound.push_back(profile.peak() >= least &&
                                profile.alignment() >= options.least_alignment);
                sum += sound.back() ? whole.slip.back() : 0.0;
            }
            for (std::size_t k = 0; k < sound.size(); ++k)
                sound[k] = sound[k] && whole.slip[k] * sum > 0.0;
            for (const auto& [first, last] : runs(sound, 5))
                if (last - first + 1 >= fewest)
                    traces.push_back(part(whole, first, last));
        }
    std::erase_if(traces, [&, all = traces](const FaultTrace& trace) {
        return contrast(field, trace, all) < options.least_contrast;
    });
    std::ranges::stable_sort(traces, std::ranges::greater{},
                             [](const FaultTrace& t) { return t.length(); });
    return traces;
}

} // namespace listric
