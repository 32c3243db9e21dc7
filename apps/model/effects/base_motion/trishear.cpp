#include "apps/model/effects/base_motion/trishear.hpp"

#include "dem/columns.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include <algorithm>
#include <cmath>
#include <limits>

namespace listric::effects::base_motion {

using namespace dem;
using Eigen::VectorXd;

namespace {

constexpr double degree = pi / 180.0;
constexpr int steps = 30;     ///< of the slip
constexpr double reach = 2.5; ///< of the fit on either side of the fault, over its height
constexpr double most_propagation = 10.0;

/// Velocity over the slip's, in the fault's frame: along it up the dip, and normal to it into the
/// moving block.
Point trishear_velocity(double along, double across, double slope) {
    if (along <= 0.0 || std::abs(across) >= slope * along)
        return {across > 0.0 ? 1.0 : 0.0, 0.0};
    const double share = across / (slope * along);
    return {0.5 * (share + 1.0), 0.25 * slope * (share * share - 1.0)};
}

/// The top that trishear makes of a level, of points that lie close where the fault meets it.
std::vector<Point> predicted_top(double level, const Trishear& shear, const SlippedFault& fault) {
    constexpr int pieces = 120;
    const double middle = fault.foot.x - (level - fault.foot.y) / tangent(fault.dip);
    const double width = (reach + 1.5) * fault.height;
    std::vector<Point> top;
    for (int k = 0; k <= pieces; ++k) {
        const double place = 2.0 * k / pieces - 1.0;
        top.push_back(carried({middle + width * (0.2 * place + 0.8 * place * place * place), level},
                              shear, fault));
    }
    return top;
}

/// Height of a point above the nearest piece of a line above or below it, m; 0 beyond its ends.
double height_above(const std::vector<Point>& line, Point p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < line.size(); ++k) {
        const Point a = line[k - 1], b = line[k];
        if ((p.x - a.x) * (p.x - b.x) > 0.0 || a.x == b.x)
            continue;
        const double height = p.y - (a.y + (b.y - a.y) * (p.x - a.x) / (b.x - a.x));
        if (std::abs(height) < std::abs(nearest))
            nearest = height;
    }
    return std::isfinite(nearest) ? nearest : 0.0;
}

/// Heights of tops above those of trishear, for Eigen: angle and propagation by unknowns that may
/// be anything.
struct TopMisfits {
    using Scalar = double;
    using InputType = VectorXd;
    using ValueType = VectorXd;
    using JacobianType = Eigen::MatrixXd;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

    std::span<const MarkerTop> tops;
    const SlippedFault& fault;
    std::size_t points;

    int inputs() const { return 2; }
    int values() const { return static_cast<int>(points); }

    static constexpr double least_angle = 5.0 * degree, most_angle = 170.0 * degree;

    Trishear at(const VectorXd& x) const {
        const auto between = [](double low, double high, double unknown) {
            return low + (high - low) * 0.5 * (1.0 + sine(unknown));
        };
        return {between(least_angle, most_angle, x(0)), between(0.0, most_propagation, x(1))};
    }

    VectorXd from(const Trishear& shear) const {
        const auto unknown = [](double low, double high, double value) {
            return arc_sine(2.0 * (value - low) / (high - low) - 1.0);
        };
        VectorXd x(2);
        x << unknown(least_angle, most_angle, shear.apical_angle),
            unknown(0.0, most_propagation, shear.propagation);
        return x;
    }

    int operator()(const VectorXd& x, VectorXd& misfits) const {
        const Trishear shear = at(x);
        Eigen::Index next = 0;
        for (const MarkerTop& top : tops) {
            const std::vector<Point> line = predicted_top(top.level, shear, fault);
            for (const Point& p : top.points)
                misfits(next++) = height_above(line, p);
        }
        return 0;
    }
};

} // namespace

Point Trishear::tip_of(const SlippedFault& fault) const {
    const double way = propagation * std::abs(fault.slip);
    return {fault.foot.x - way * cosine(fault.dip), fault.foot.y + way * sine(fault.dip)};
}

Point carried(Point p, const Trishear& shear, const SlippedFault& fault) {
    const Point up{-cosine(fault.dip), sine(fault.dip)}, across{up.y, -up.x};
    const Point from{p.x - fault.foot.x, p.y - fault.foot.y};
    Point q{dot(from, up), dot(from, across)};
    const double slope = tangent(0.5 * shear.apical_angle);
    const double step = -fault.slip / steps, advance = shear.propagation * std::abs(step);
    for (int k = 0; k < steps; ++k) { // midpoint rule
        const double tip = (k + 0.5) * advance;
        const Point first = trishear_velocity(q.x - (tip - 0.5 * advance), q.y, slope);
        const Point v =
            trishear_velocity(q.x + 0.5 * step * first.x - tip, q.y + 0.5 * step * first.y, slope);
        q = {q.x + step * v.x, q.y + step * v.y};
    }
    return {fault.foot.x + q.x * up.x + q.y * across.x, fault.foot.y + q.x * up.y + q.y * across.y};
}

std::optional<TrishearFit> fit_trishear(std::span<const MarkerTop> tops,
                                        const SlippedFault& fault) {
    constexpr std::size_t fewest = 8;
    std::size_t points = 0;
    for (const MarkerTop& top : tops)
        points += top.points.size();
    if (points < fewest || fault.slip == 0.0)
        return std::nullopt;
    using Gradients = Eigen::NumericalDiff<TopMisfits>;
    // Steps of the gradients cross some pieces of the lines, whose corners then do not matter.
    constexpr double square_of_step = 1e-6;
    std::optional<TrishearFit> best;
    for (const double angle : {40.0, 90.0})
        for (const double propagation : {0.5, 2.0, 4.0}) {
            Gradients misfits(TopMisfits{tops, fault, points}, square_of_step);
            VectorXd x = misfits.from({angle * degree, propagation});
            Eigen::LevenbergMarquardt<Gradients> solver(misfits);
            solver.parameters.maxfev = 60;
            solver.minimize(x);
            const double misfit =
                std::sqrt(solver.fvec.squaredNorm() / static_cast<double>(points));
            if (std::isfinite(misfit) && (!best || misfit < best->misfit))
                best = TrishearFit{misfits.at(x), misfit};
        }
    return best;
}

std::vector<MarkerTop> marker_tops(const State& state, const SlippedFault& fault) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<MarkerTop> tops;
    for (const double share : {0.2, 0.4, 0.6, 0.8}) {
        MarkerTop top{-share * fault.height, {}};
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (d.stratum[i] == 0 && std::abs(d.start_y[i] - top.level) < state.mean_radius &&
                std::abs(d.x[i] - fault.foot.x) < reach * fault.height)
                top.points.push_back({d.x[i], d.y[i] - (d.start_y[i] - top.level)});
        tops.push_back(std::move(top));
    }
    return tops;
}

} // namespace listric::effects::base_motion
