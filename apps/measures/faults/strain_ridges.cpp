#include "apps/measures/faults/strain_ridges.hpp"

#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

namespace listric::measures {

using namespace dem;

namespace {

/// The strain smoothed by a Gaussian of one mean diameter, on a square grid of half a
/// diameter.
class SmoothStrain {
public:
    explicit SmoothStrain(const StrainedPlaces& field) : step_(0.5 * field.diameter) {
        const auto [left, right] = std::ranges::minmax(field.x);
        const auto [bottom, top] = std::ranges::minmax(field.y);
        left_ = left - 4.0 * step_;
        bottom_ = bottom - 4.0 * step_;
        columns_ = static_cast<std::ptrdiff_t>((right - left_) / step_) + 6;
        rows_ = static_cast<std::ptrdiff_t>((top - bottom_) / step_) + 6;
        std::vector<double> amount(static_cast<std::size_t>(columns_ * rows_), 0.0), weight(amount);
        spread(field, amount, weight);
        blur(amount);
        blur(weight);
        // About 0.27 discs per grid cell, of a diameter; half of that is at an edge.
        const double least_weight = 0.15 * field.discs_across * field.discs_across;
        values_.assign(amount.size(), 0.0);
        for (std::size_t k = 0; k < amount.size(); ++k)
            if (weight[k] > least_weight)
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
        const double angle = 0.5 * dem::arc_tangent(2.0 * xy, xx - yy);
        return {dem::cosine(angle), dem::sine(angle)};
    }

    double step() const { return step_; }

private:
    std::size_t at(std::ptrdiff_t c, std::ptrdiff_t r) const {
        return static_cast<std::size_t>(c * rows_ + r);
    }

    /// Bilinear shares of the discs, of their strain and of one.
    void spread(const StrainedPlaces& field, std::vector<double>& amount,
                std::vector<double>& weight) const {
        for (std::size_t k = 0; k < field.x.size(); ++k) {
            const double u = (field.x[k] - left_) / step_, v = (field.y[k] - bottom_) / step_;
            const auto c = static_cast<std::ptrdiff_t>(u), r = static_cast<std::ptrdiff_t>(v);
            const double fu = u - static_cast<double>(c), fv = v - static_cast<double>(r);
            const double strain = field.strain[k];
            for (std::ptrdiff_t dc : {0, 1})
                for (std::ptrdiff_t dr : {0, 1}) {
                    const double share = (dc ? fu : 1.0 - fu) * (dr ? fv : 1.0 - fv);
                    amount[at(c + dc, r + dr)] += share * strain;
                    weight[at(c + dc, r + dr)] += share;
                }
        }
    }

    /// In two one-dimensional passes.
    void blur(std::vector<double>& values) const {
        constexpr std::ptrdiff_t reach = 6;
        constexpr double deviation = 2.0; // grid steps
        double kernel[reach + 1], sum = 0.0;
        for (std::ptrdiff_t k = 0; k <= reach; ++k) {
            kernel[k] =
                dem::exponential(-0.5 * static_cast<double>(k * k) / (deviation * deviation));
            sum += (k ? 2.0 : 1.0) * kernel[k];
        }
        for (double& k : kernel)
            k /= sum;
        std::vector<double> other(values.size(), 0.0);
        const auto mean = [&](const std::vector<double>& from, std::ptrdiff_t c, std::ptrdiff_t r,
                              bool along_columns) {
            double value = 0.0;
            for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
                const std::ptrdiff_t cc = along_columns ? c + k : c;
                const std::ptrdiff_t rr = along_columns ? r : r + k;
                if (cc >= 0 && cc < columns_ && rr >= 0 && rr < rows_)
                    value += kernel[std::abs(k)] * from[at(cc, rr)];
            }
            return value;
        };
        const auto pass = [&](const std::vector<double>& from, std::vector<double>& to,
                              bool along_columns) {
            in_pieces(static_cast<std::size_t>(columns_), 32, [&](std::size_t c, std::size_t end) {
                for (; c < end; ++c)
                    for (std::ptrdiff_t r = 0; r < rows_; ++r) {
                        const auto column = static_cast<std::ptrdiff_t>(c);
                        to[at(column, r)] = mean(from, column, r, along_columns);
                    }
            });
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

Nearby nearest_line(const std::vector<Polyline>& lines, Point p) {
    Nearby best;
    double square = 1e300; // roots take longest: only of points that may be the nearest
    for (const auto& line : lines)
        for (std::size_t k = 0; k < line.size(); ++k) {
            const Point off = p - line[k];
            if (dot(off, off) > square)
                continue;
            if (const double distance = norm(off); distance < best.distance) {
                best = {distance, line[std::min(k + 1, line.size() - 1)] - line[k > 0 ? k - 1 : 0]};
                square = (1.0 + 1e-9) * dot(off, off);
            }
        }
    return best;
}

/// Mean of the last steps' directions.
Point mean_direction(const std::vector<Point>& behind) {
    Point sum;
    for (Point b : behind)
        sum = sum + b;
    return unit(sum);
}

/// Where to go on from p: half way between where the line came from and the ridge, unless that
/// turns away by more than 60 degrees.
Point heading(const SmoothStrain& strain, Point p, Point mean) {
    Point along = strain.ridge_direction(p);
    if (dot(along, mean) < 0.0)
        along = -1.0 * along;
    return dot(along, mean) > 0.5 ? unit(mean + along) : mean;
}

/// The largest strain within 0.6 of a step to either side of a point.
struct Crest {
    double strain = -1.0, shift = 0.0; ///< shift, m along `across`
};

Crest crest_beside(const SmoothStrain& strain, Point p, Point across) {
    Crest best;
    for (int k = -3; k <= 3; ++k)
        if (const double f = strain.value(p + 0.2 * k * strain.step() * across);
            f > best.strain * (1.0 + 1e-9))
            best = {f, 0.2 * k * strain.step()};
    return best;
}

/// Whether a line's end is where it has been before.
bool has_come_back(const Polyline& line, double step) {
    for (std::size_t k = 0; k + 12 < line.size(); ++k)
        if (norm(line[k] - line.back()) < 2.0 * step)
            return true;
    return false;
}

/// Follows a ridge from `start` along `direction` until it ends, turns sharply or joins a line
/// found before; lines that cross at a large angle are crossed. `start` is not repeated.
Polyline follow(const SmoothStrain& strain, Point start, Point direction, const RidgeLimits& limits,
                const std::vector<Polyline>& lines) {
    const double step = strain.step();
    constexpr std::size_t most = 4000;
    const int longest_crossing = 4 + static_cast<int>(3.0 * limits.spacing / step);
    Polyline line;
    std::vector<Point> behind(10, direction); // directions of the last steps
    Point p = start;
    int crossing = 0;
    for (std::size_t n = 0; n < most; ++n) {
        const Point mean = mean_direction(behind);
        const Point ahead = crossing == 0 ? heading(strain, p, mean) : mean;
        const Point across{-ahead.y, ahead.x};
        Point next = p + step * ahead;
        const Crest crest = crest_beside(strain, next, across);
        if (const Nearby other = nearest_line(lines, next); other.distance < limits.spacing) {
            const Point d = unit(other.direction);
            if (std::abs(dot(d, ahead)) > 0.85 || ++crossing > longest_crossing)
                break; // joins it
        } else {
            crossing = 0;
            next = next + crest.shift * across;
        }
        const Point moved = unit(next - p);
        if (crest.strain < limits.least_strain || dot(moved, mean) < 0.6)
            break;
        behind.erase(behind.begin());
        behind.push_back(moved);
        p = next;
        line.push_back(p);
        if (has_come_back(line, step))
            return line;
    }
    if (crossing > 0)
        line.resize(line.size() - std::min(line.size(), static_cast<std::size_t>(crossing)));
    return line;
}

/// Points on crests with certain strain, the most strained first.
std::vector<Point> find_seeds(const SmoothStrain& strain, double certain) {
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
    std::vector<Point> places;
    for (const auto& [f, place] : seeds)
        places.push_back(place);
    return places;
}

/// The ridge through a seed, both ways.
Polyline follow_both_ways(const SmoothStrain& strain, Point seed, const RidgeLimits& limits,
                          const std::vector<Polyline>& lines) {
    const Point direction = strain.ridge_direction(seed);
    Polyline line = follow(strain, seed, -1.0 * direction, limits, lines);
    std::ranges::reverse(line);
    line.push_back(seed);
    const Polyline onward = follow(strain, seed, direction, limits, lines);
    line.insert(line.end(), onward.begin(), onward.end());
    return line;
}

/// Direction of a line's end over eight diameters.
Point end_direction(const Polyline& line) {
    const std::size_t back = std::min<std::size_t>(line.size() - 1, 16);
    return unit(line.back() - line[line.size() - 1 - back]);
}

/// Joins b to the end of a if it goes on in it: beyond a gap of up to 10 diameters or a side step
/// of up to five.
bool join_lines(Polyline& a, Polyline& b, double diameter) {
    const double cosine = dem::cosine(30.0 * pi / 180.0);
    const Point gap = b.front() - a.back();
    const Point out = end_direction(a);
    const Point in = -1.0 * end_direction(Polyline(b.rbegin(), b.rend()));
    const double along = dot(gap, out), across = std::abs(cross(out, gap));
    const bool straight = along > 0.0 && across < std::max(2.0 * diameter, 0.58 * along);
    const bool stepped = along > -4.0 * diameter && across < 5.0 * diameter;
    if (norm(gap) > 10.0 * diameter || dot(out, in) < cosine || !(straight || stepped))
        return false;
    if (!straight) {
        // A side step: it is bridged over ten diameters, and what overlaps goes.
        const double spare = std::max(0.0, 10.0 * diameter - along);
        const auto points = static_cast<std::size_t>(spare / diameter);
        if (a.size() < 2 * points + 8 || b.size() < 2 * points + 8)
            return false;
        a.resize(a.size() - points);
        b.erase(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(points));
    }
    const Point bridge = b.front() - a.back();
    const auto steps = static_cast<int>(norm(bridge) / (0.5 * diameter));
    for (int k = 1; k <= steps; ++k)
        a.push_back(b.front() - (1.0 - static_cast<double>(k) / (steps + 1)) * bridge);
    a.insert(a.end(), b.begin(), b.end());
    return true;
}

/// Joins the first two lines that go on in each other. False: there are none.
bool join_two(std::vector<Polyline>& lines, double diameter) {
    for (std::size_t a = 0; a < lines.size(); ++a)
        for (std::size_t b = a + 1; b < lines.size(); ++b)
            for (int turns = 0; turns < 4; ++turns) {
                // All pairings of ends: the end of a with the start of b.
                std::ranges::reverse(turns % 2 ? lines[a] : lines[b]);
                if (join_lines(lines[a], lines[b], diameter)) {
                    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(b));
                    return true;
                }
            }
    return false;
}

} // namespace

std::vector<Polyline> find_ridges(const StrainedPlaces& places, const RidgeLimits& limits) {
    if (places.x.empty())
        return {};
    const SmoothStrain strain(places);
    std::vector<Polyline> lines;
    std::vector<Point> tried;
    for (Point seed : find_seeds(strain, limits.certain_strain)) {
        const auto is_near = [&](Point t) { return norm(t - seed) < 2.0 * strain.step(); };
        if (nearest_line(lines, seed).distance < limits.spacing ||
            std::ranges::any_of(tried, is_near))
            continue;
        Polyline line = follow_both_ways(strain, seed, limits, lines);
        if (length_of(line) < limits.least_length)
            tried.push_back(seed);
        else
            lines.push_back(std::move(line));
    }
    while (join_two(lines, places.diameter)) {
    }
    return lines;
}

} // namespace listric::measures
