#include "apps/scene/picks/fault_fit.hpp"

#include "apps/support/stopwatch.hpp"
#include "apps/support/words/log.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <Eigen/Dense>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include <algorithm>
#include <cmath>
#include <optional>

namespace listric {

using namespace dem;

namespace {

using Eigen::VectorXd;

constexpr std::size_t most_pieces = 16;
constexpr std::size_t most_fitted = 200; ///< points; of more, as many evenly along the fault
constexpr double close_enough = 0.25;    ///< of the tolerance
constexpr double worth_a_piece = 0.8;    ///< of the root mean square before it
constexpr double degree = pi / 180.0;

/// Dips at the joints, radians, and lengths of the pieces between them, m. Beyond the last joint is
/// a line.
struct Pieces {
    std::vector<double> dip, length;

    double end() const {
        double sum = 0.0;
        for (double l : length)
            sum += l;
        return sum;
    }
};

double turn_of(const Pieces& pieces, std::size_t k) { return pieces.dip[k] - pieces.dip[k + 1]; }

Point along(double dip) { return {dem::cosine(dip), -dem::sine(dip)}; }

/// @param reach  of the line at the end, m
Chain chain_of(const Pieces& pieces, double reach) {
    Chain chain;
    Point start{0.0, 0.0};
    for (std::size_t k = 0; k < pieces.length.size(); ++k) {
        const double turn = turn_of(pieces, k), length = pieces.length[k];
        const Point tangent = along(pieces.dip[k]);
        chain.push_back(std::abs(turn) < 1e-9 ? line(start, start + length * tangent)
                                              : arc(start, tangent, length / std::abs(turn), turn));
        start = chain.back().end;
    }
    chain.push_back(line(start, start + reach * along(pieces.dip.back())));
    return chain;
}

/// Distance with the side as its sign, m.
double signed_distance(const Chain& chain, Point p) {
    if (const auto foot = nearest(chain, p))
        return foot->distance;
    return std::min(norm(p - chain.front().start), norm(p - chain.back().end));
}

} // namespace

double distance_from(const Chain& detachment, Point point) {
    return std::abs(signed_distance(detachment, point));
}

namespace {

/// Residuals of the points by what is free: dips, so that they stay within 0 and 90 degrees, and
/// logarithms of lengths.
struct Distances {
    using Scalar = double;
    using InputType = VectorXd;
    using ValueType = VectorXd;
    using JacobianType = Eigen::MatrixXd;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

    std::span<const Point> points;
    double reach;    ///< of the line at the end, m
    double shortest; ///< piece, m
    std::size_t pieces;
    bool flat_end;

    int inputs() const { return static_cast<int>(2 * pieces + (flat_end ? 0 : 1)); }
    int values() const { return static_cast<int>(std::max(points.size(), 2 * pieces + 1)); }

    Pieces at(const VectorXd& x) const {
        Pieces p;
        Eigen::Index next = 0;
        for (std::size_t k = 0; k < pieces; ++k)
            p.length.push_back(shortest +
                               dem::exponential(std::min(x(next++), dem::logarithm(1e6))));
        for (std::size_t k = 0; k < pieces + (flat_end ? 0 : 1); ++k)
            p.dip.push_back(0.25 * pi * (1.0 + dem::sine(x(next++))));
        if (flat_end)
            p.dip.push_back(0.0);
        return p;
    }
    VectorXd from(const Pieces& p) const {
        VectorXd x(inputs());
        Eigen::Index next = 0;
        for (double length : p.length)
            x(next++) = dem::logarithm(std::max(1.0, length - shortest));
        for (std::size_t k = 0; k < pieces + (flat_end ? 0 : 1); ++k) {
            // At an end of the range nothing would change with x.
            const double share = std::clamp(p.dip[k] / (0.25 * pi) - 1.0, -0.9999, 0.9999);
            x(next++) = dem::arc_sine(share);
        }
        return x;
    }
    int operator()(const VectorXd& x, VectorXd& residual) const {
        const Chain chain = chain_of(at(x), reach);
        residual.setZero();
        for (std::size_t k = 0; k < points.size(); ++k)
            residual(static_cast<Eigen::Index>(k)) = signed_distance(chain, points[k]);
        return 0;
    }
};

struct Fitted {
    Pieces pieces;
    double square = 0.0; ///< sum of squares, m^2
};

/// The pieces with joints at two places, m along the fault, of these dips.
Pieces with_joints(Pieces pieces, std::initializer_list<std::pair<double, double>> joints) {
    for (const auto& [place, dip] : joints) {
        double before = 0.0;
        std::size_t k = 0;
        while (k < pieces.length.size() && before + pieces.length[k] < place)
            before += pieces.length[k++];
        const double first = std::max(1.0, place - before);
        const auto at = static_cast<std::ptrdiff_t>(k);
        if (k < pieces.length.size())
            pieces.length[k] = std::max(1.0, pieces.length[k] - first);
        pieces.length.insert(pieces.length.begin() + at, first);
        pieces.dip.insert(pieces.dip.begin() + at + 1, dip);
    }
    return pieces;
}

double dip_at(const Pieces& pieces, double place) {
    double before = 0.0;
    for (std::size_t k = 0; k < pieces.length.size(); before += pieces.length[k++])
        if (place < before + pieces.length[k])
            return pieces.dip[k] - turn_of(pieces, k) * (place - before) / pieces.length[k];
    return pieces.dip.back();
}

/// Dip of the line from one point to another, within 0 and 90 degrees.
double dip_between(Point a, Point b) {
    return std::clamp(dem::arc_tangent(a.y - b.y, b.x - a.x), 0.0, 0.5 * pi);
}

class Fit {
public:
    Fit(std::span<const Point> points, double tolerance) : tolerance_(tolerance) {
        const std::size_t n = points.size(), kept = std::min(n, most_fitted);
        for (std::size_t k = 0; k < kept; ++k)
            points_.push_back(points[k * (n - 1) / (kept - 1)]);
        places_.push_back(norm(points_[0]));
        for (std::size_t k = 1; k < kept; ++k)
            places_.push_back(places_.back() + norm(points_[k] - points_[k - 1]));
        reach_ = 2.0 * places_.back();
    }

    Fitted free_end() {
        const std::size_t last = points_.size() - 1;
        const Pieces start{
            {dip_between({0.0, 0.0}, points_[1]), dip_between(points_[last - 1], points_[last])},
            {0.7 * places_.back()}};
        return refined(fit_from(start, false), false);
    }

    Fitted flat_end(Pieces pieces) {
        pieces.dip.back() = 0.0;
        return refined(fit_from(pieces, true), true);
    }

    double length() const { return places_.back(); }

private:
    Fitted fit_from(const Pieces& start, bool flat_end) const {
        using Gradients = Eigen::NumericalDiff<Distances>;
        Gradients distances(Distances{points_, reach_, tolerance_, start.length.size(), flat_end});
        VectorXd x = distances.from(start);
        Eigen::LevenbergMarquardt<Gradients> solver(distances);
        solver.parameters.maxfev = 200 * (distances.inputs() + 1);
        solver.minimize(x);
        return {distances.at(x), solver.fvec.squaredNorm()};
    }

    std::pair<std::size_t, double> worst(const Fitted& fitted) const {
        const Chain chain = chain_of(fitted.pieces, reach_);
        std::pair<std::size_t, double> found{0, 0.0};
        for (std::size_t k = 0; k < points_.size(); ++k)
            if (const double off = std::abs(signed_distance(chain, points_[k])); off > found.second)
                found = {k, off};
        return found;
    }

    /// The best of several ways to add a joint, or a pair that makes a corner.
    Fitted with_another(const Fitted& before, std::size_t worst_point, bool flat_end) const {
        const Pieces& p = before.pieces;
        const double place = places_[worst_point];
        std::vector<Pieces> ways;
        const auto joint = [&](double s) { ways.push_back(with_joints(p, {{s, dip_at(p, s)}})); };
        joint(place);
        double begin = 0.0;
        for (double length : p.length) {
            joint(begin + 0.5 * length);
            begin += length;
        }
        if (begin < length())
            joint(0.5 * (begin + length()));
        const std::size_t last = points_.size() - 1;
        for (const std::size_t k : {worst_point, worst_point + 1})
            if (k > 0 && k < last) {
                const double wide = 0.5 * tolerance_;
                ways.push_back(with_joints(
                    p, {{std::max(1.0, places_[k] - wide), dip_between(points_[k - 1], points_[k])},
                        {places_[k] + wide, dip_between(points_[k], points_[k + 1])}}));
            }
        std::optional<Fitted> best;
        for (const Pieces& start : ways)
            if (Fitted fitted = fit_from(start, flat_end); !best || fitted.square < best->square)
                best = std::move(fitted);
        return *best;
    }

    Fitted refined(Fitted fitted, bool flat_end) {
        while (fitted.pieces.length.size() < most_pieces) {
            tell_that_it_takes_long();
            const auto [point, off] = worst(fitted);
            if (off <= close_enough * tolerance_)
                break;
            Fitted next = with_another(fitted, point, flat_end);
            if (off <= tolerance_ && next.square > worth_a_piece * worth_a_piece * fitted.square)
                break;
            if (next.square >= fitted.square)
                break;
            fitted = std::move(next);
        }
        while (fitted.pieces.length.size() > 1) {
            auto fewer = with_one_less(fitted, flat_end);
            if (!fewer)
                break;
            fitted = std::move(*fewer);
        }
        return fitted;
    }

    /// Without the joint that is missed least, if what it adds is not worth a piece.
    std::optional<Fitted> with_one_less(const Fitted& before, bool flat_end) const {
        std::optional<Fitted> best;
        for (std::size_t k = 1; k < before.pieces.dip.size(); ++k) {
            Pieces start = before.pieces;
            const auto at = static_cast<std::ptrdiff_t>(k);
            if (k < start.length.size())
                start.length[k - 1] += start.length[k];
            start.length.erase(start.length.begin() + std::min(at, std::ssize(start.length) - 1));
            start.dip.erase(start.dip.begin() + at);
            if (Fitted fitted = fit_from(start, flat_end); !best || fitted.square < best->square)
                best = std::move(fitted);
        }
        const double off = worst(*best).second;
        const bool good =
            off <= close_enough * tolerance_ ||
            (off <= tolerance_ && worth_a_piece * worth_a_piece * best->square <= before.square);
        return good ? best : std::nullopt;
    }

    /// Once; a fault that bends much takes a few seconds.
    void tell_that_it_takes_long() {
        if (told_ || seconds_since(since_) < 2.0)
            return;
        warn("arcs and lines are fitted to the picked fault, which takes some seconds the first "
             "time");
        told_ = true;
    }

    double tolerance_, reach_ = 0.0;
    bool told_ = false;
    SteadyClock::time_point since_ = SteadyClock::now();
    std::vector<Point> points_;
    std::vector<double> places_; ///< along the fault, m
};

/// Whether the end is flat: its line descends by no more than the tolerance within the points, or
/// the arc before it would by going on until it is flat.
bool ends_flat(const Pieces& pieces, double length, double tolerance) {
    const double dip = pieces.dip.back();
    if (std::max(0.0, length - pieces.end()) * dem::sine(dip) <= tolerance && dip < 0.5 * pi * 0.1)
        return true;
    const std::size_t last = pieces.length.size() - 1;
    const double turn = turn_of(pieces, last);
    return turn > 0.0 && (1.0 - dem::cosine(dip)) * pieces.length[last] / turn <= tolerance;
}

/// A piece that turns by less than 0.006 degrees is a line: a scene has no arc of so large a
/// radius.
DetachmentSegment segment_of(const Pieces& pieces, std::size_t k) {
    const double turn = turn_of(pieces, k), length = pieces.length[k];
    return std::abs(turn) < 1e-4 ? straight(length)
                                 : arc_to_dip(pieces.dip[k + 1] / degree, length / std::abs(turn));
}

Pieces without_slight_dips(Pieces pieces) {
    constexpr double slight = 0.5 * degree;
    for (double& dip : pieces.dip)
        dip = dip < slight ? 0.0 : dip > 0.5 * pi - slight ? 0.5 * pi : dip;
    return pieces;
}

FaultFit as_segments(const Pieces& pieces, std::span<const Point> points, double length) {
    FaultFit fit;
    fit.start_dip = pieces.dip.front() / degree;
    for (std::size_t k = 0; k < pieces.length.size(); ++k)
        fit.segments.push_back(segment_of(pieces, k));
    fit.segments.push_back(straight(length));
    measure_misfit(fit, points);
    return fit;
}

} // namespace

void measure_misfit(FaultFit& fit, std::span<const Point> points) {
    const Chain chain =
        detachment_chain({.start_dip = fit.start_dip, .segments = fit.segments}, 0.0);
    fit.misfit = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (const double off = distance_from(chain, points[k]); off > fit.misfit) {
            fit.misfit = off;
            fit.worst = k;
        }
}

FaultFit fit_fault(std::span<const Point> points, double tolerance) {
    Fit fit(points, tolerance);
    const Pieces free = fit.free_end().pieces;
    const Pieces pieces = fit.flat_end(free).pieces;
    FaultFit result = as_segments(pieces, points, fit.length());
    // A piece that is flat or upright except for noise is made so.
    if (FaultFit plain = as_segments(without_slight_dips(pieces), points, fit.length());
        plain.misfit <= std::min(tolerance, result.misfit + close_enough * tolerance))
        result = std::move(plain);
    result.end_dip = dip_at(free, fit.length()) / degree;
    result.flat = ends_flat(free, fit.length(), tolerance);
    return result;
}

} // namespace listric
