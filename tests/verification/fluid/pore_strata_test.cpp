// Pressure does not depend on the time from stratum to stratum: a column of discs on a floor that
// sinks, filled up in strata of 2,500, 5,000 and 10,000 a, in which the event that a run has solves
// for the water every 2,500 a, against continuous deposition.
//
// The continuous solution shares no code with it: equivalent depth as a function of the share of
// the grains below, finite volumes that grow with the column, implicit Euler. Half the cells and
// steps change it by .002.
//
// Tolerance: .015, and 15 % where the ratio is small. Steps of 2,500 a cost up to .006 (see
// pore_column_test), rows of discs as much. Without the pending stratum ratios at 0.5 km are .06
// too low with strata every 10,000 a, or a sixth of what they are with 3e-17 m^2.

#include "fluid/pore_column.hpp"
#include "fluid/pore_fluid.hpp"
#include "tests/support.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace listric::pore_strata_test {

using namespace dem;
using namespace fluid;
namespace {

using namespace support;

constexpr double year = 31557600.0, decay = 4e-4, fresh = 0.5, viscosity = 5e-4;
constexpr double weight = (2600.0 - 1030.0) * standard_gravity; // of grains in water, N/m^3
constexpr double depths[] = {500.0, 1000.0, 2000.0, 4000.0};

/// Numbers by depth, linear between them.
double at_depth(const std::map<double, double>& profile, double depth) {
    const auto below = profile.lower_bound(depth);
    if (below == profile.begin() || below == profile.end())
        return std::nan("");
    const auto above = std::prev(below);
    const double share = (depth - above->first) / (below->first - above->first);
    return above->second + share * (below->second - above->second);
}

// ---- laid down continuously

/// Sediment at an equivalent depth.
struct Mud {
    explicit Mud(double z) : porosity(fresh * std::exp(-decay * z)) {}

    double porosity;
    double solid() const { return 1.0 - porosity; }
    double ratio() const { return porosity / solid(); }
    /// Over viscosity.
    double permeability(double at_fifth) const {
        return at_fifth * std::pow(porosity, 3) / std::pow(solid(), 2) / (0.008 / 0.64) / viscosity;
    }
};

class ContinuousColumn {
public:
    ContinuousColumn(double permeability, double rate, std::size_t cells)
        : k_(permeability), rate_(rate), z_(cells, 0.0) {}

    /// Sinks for a time, s.
    void sink(double seconds, int steps) {
        const double step = seconds / (steps + 1.0);
        grains_ = (1.0 - fresh) * rate_ * step;
        for (int k = 0; k < steps; ++k)
            advance(step);
    }

    /// Excess pressure over the weight of grains in water, by depth.
    std::map<double, double> profile() const {
        std::map<double, double> ratios;
        double depth = 0.0;
        for (std::size_t i = z_.size(); i-- > 0;) {
            const double thickness = share() * grains_ / Mud(z_[i]).solid();
            const double above = grains_ * (1.0 - share() * (static_cast<double>(i) + 0.5));
            const double borne = z_[i] + fresh / decay * std::expm1(-decay * z_[i]);
            ratios[depth + 0.5 * thickness] = 1.0 - borne / above;
            depth += thickness;
        }
        return ratios;
    }

private:
    double share() const { return 1.0 / static_cast<double>(z_.size()); }

    /// Water that passes the grains upward between equivalent depths a distance of grains apart.
    double flux(double below, double above, double distance) const {
        const Mud mud(0.5 * (below + above));
        return mud.permeability(k_) * mud.solid() * weight *
               (1.0 + mud.solid() * (above - below) / distance);
    }

    /// Shortfall of the balance of every cell after a step in which the grains grew by so much.
    std::vector<double> missing(const std::vector<double>& z, const std::vector<double>& before,
                                double grains, double growth, double step) const {
        const std::size_t n = z.size();
        std::vector<double> out(n);
        double leaves = 0.0; // through the lower face
        for (std::size_t i = 0; i < n; ++i) {
            const bool top = i + 1 == n;
            const double next = top ? 0.0 : z[i + 1];
            const double q = flux(z[i], next, (top ? 0.5 : 1.0) * share() * grains);
            const double face = share() * static_cast<double>(i + 1) * growth / step;
            const double up = q - face * Mud(top ? 0.0 : 0.5 * (z[i] + next)).ratio();
            out[i] = share() * (grains * Mud(z[i]).ratio() - (grains - growth) * before[i]) / step +
                     up - leaves;
            leaves = up;
        }
        return out;
    }

    void advance(double step) {
        const std::size_t n = z_.size();
        const double through_top = flux(z_.back(), 0.0, 0.5 * share() * grains_);
        const double growth = step * (rate_ + through_top) * (1.0 - fresh);
        std::vector<double> before;
        for (const double z : z_)
            before.push_back(Mud(z).ratio());
        grains_ += growth;
        for (int newton = 0; newton < 20; ++newton) {
            const std::vector<double> now = missing(z_, before, grains_, growth, step);
            // Columns of the Jacobian, every third at a time.
            constexpr double moved = 1e-4; // m
            std::vector<double> lower(n), middle(n), upper(n), change(n);
            for (std::size_t colour = 0; colour < 3; ++colour) {
                std::vector<double> z = z_;
                for (std::size_t i = colour; i < n; i += 3)
                    z[i] += moved;
                const std::vector<double> then = missing(z, before, grains_, growth, step);
                for (std::size_t i = 0; i < n; ++i) {
                    const double slope = (then[i] - now[i]) / moved;
                    const std::size_t of = (i + 3 - colour) % 3; // 0: own, 1: from below
                    (of == 0 ? middle : of == 1 ? lower : upper)[i] = slope;
                }
            }
            for (std::size_t i = 1; i < n; ++i) // Thomas
                middle[i] -= lower[i] / middle[i - 1] * upper[i - 1];
            std::vector<double> right = now;
            for (std::size_t i = 1; i < n; ++i)
                right[i] -= lower[i] / middle[i - 1] * right[i - 1];
            double greatest = 0.0;
            for (std::size_t i = n; i-- > 0;) {
                change[i] = (right[i] - (i + 1 < n ? upper[i] * change[i + 1] : 0.0)) / middle[i];
                greatest = std::max(greatest, std::abs(change[i]));
            }
            for (std::size_t i = 0; i < n; ++i)
                z_[i] -= change[i];
            if (greatest < 1e-6)
                break;
        }
    }

    double k_, rate_;
    double grains_ = 0.0;   ///< height of all, m
    std::vector<double> z_; ///< equivalent depth by equal shares of the grains, from the floor up
};

std::map<double, double> laid_down_continuously(double permeability, double rate, double years,
                                                std::size_t cells = 60, int steps = 3000) {
    ContinuousColumn column(permeability, rate / year, cells);
    column.sink(years * year, steps);
    return column.profile();
}

TEST(PoreStrata, TheContinuousColumnConverges) {
    // 7.5 km/Ma, 0.6 Ma; beside it what another program has, to three digits.
    const std::map<double, std::vector<double>> other{{1e-18, {.259, .284, .328, .349}},
                                                      {3e-18, {.107, .123, .161, .205}},
                                                      {3e-17, {.013, .015, .022, .038}}};
    for (const auto& [permeability, ratios] : other) {
        const auto fine = laid_down_continuously(permeability, 7.5e-3, 6e5);
        const auto coarse = laid_down_continuously(permeability, 7.5e-3, 6e5, 30, 1500);
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_NEAR(at_depth(fine, depths[k]), at_depth(coarse, depths[k]), 0.0025)
                << depths[k];
            EXPECT_NEAR(at_depth(fine, depths[k]), ratios[k], 0.003) << depths[k];
        }
    }
}

TEST(PoreStrata, AnExplainedColumnIsContinuous) {
    for (const double permeability : {4e-19, 1e-18, 3e-17})
        for (const double rate : {2.5e-3, 9e-3}) {
            const double years = 1e6, floor = rate * years;
            MudColumn column;
            column.law.grain_weight = weight;
            column.mud.at_fifth = permeability;
            const SteadyColumn sunk = sink_steadily(column, floor, years * year);
            const auto exact = laid_down_continuously(permeability, rate, years);
            for (const double depth : {0.2 * floor, 0.5 * floor})
                EXPECT_NEAR(sunk.at(depth).overpressure_ratio, at_depth(exact, depth), 0.005)
                    << permeability << ", " << rate << ", " << depth;
        }
}

// ---- laid down in strata

/// Rows of discs, one a stratum, on a row of rock that sinks. They compact at once as the water
/// wants it.
class DiscColumn {
public:
    DiscColumn(double permeability, double rate, double between_strata)
        : rate_(rate), every_(static_cast<int>(std::lround(between_strata / interval))),
          width_(0.25 * pi * 1.15 * rate * between_strata), base_(walls(width_ * columns)),
          event_(fluid(permeability), sediment(between_strata, width_), standard_gravity, travel) {
        std::vector<Disc> rock;
        for (int c = 0; c < columns; ++c)
            rock.push_back({(c + 0.5) * width_, 0.0, mean_radius(width_)});
        state_ = make_state(rock);
        state_.mean_radius = mean_radius(width_);
        state_.discs.add<double>("porosity", "1", fresh);
        event_.begin(state_);
    }

    /// Sinks up to a time, a, and solves for the water then.
    void sink_to(double years) {
        while ((static_cast<double>(solved_) + 0.5) * interval < years) {
            if (solved_ > 0 && solved_ % every_ == 0)
                lay_down();
            ++solved_;
            state_.clock.travel = Travel(travel * interval * solved_);
            place();
            event_.apply(state_, base_);
            ++event_.applied;
            const auto wanted = state_.discs.get<double>("wanted_porosity");
            std::ranges::copy(wanted, state_.discs.get<double>("porosity").begin());
        }
    }

    std::map<double, double> profile() const {
        const ConstDiscColumns d = disc_columns(state_);
        const auto ratio = state_.discs.get<double>("overpressure_ratio");
        std::map<double, double> ratios;
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (d.stratum[i] > 0 && i % columns == columns / 2)
                ratios[-d.y[i]] = ratio[i];
        return ratios;
    }

    const State& state() const { return state_; }

private:
    static constexpr int columns = 8;
    static constexpr double interval = 2500.0, travel = 0.01; // a, m/a

    static double mean_radius(double width) { return 2.0 / pi * width; }

    static RigidBase walls(double width) {
        constexpr double far = 2e4;
        RigidBase base;
        base.surfaces = {{"floor", {line({0.0, -far}, {width, -far})}},
                         {"left", {line({0.0, far}, {0.0, -far})}},
                         {"right", {line({width, -far}, {width, far})}}};
        base.motion.speed = 1.0;
        return base;
    }

    static PoreFluidParameters fluid(double permeability) {
        PoreFluidParameters p;
        p.interval = interval;
        p.flow.permeability.at_fifth = permeability;
        return p;
    }

    /// The line is as far above the rows' top as a run's is above its ground.
    static WetSediment sediment(double between_strata, double width) {
        WetSediment s;
        s.surface = Target(WetGround::left_free * mean_radius(width));
        s.deposition = {between_strata, travel};
        return s;
    }

    double height(std::size_t i) const {
        const ConstDiscColumns d = disc_columns(state_);
        const double solid = 1.0 - state_.discs.get<double>("porosity")[i];
        return d.mass[i] / 2600.0 / width_ / solid;
    }

    /// Top of the rows, m.
    double place() {
        const DiscColumns d = disc_columns(state_);
        double top = -rate_ * interval * solved_;
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const bool rock = d.stratum[i] == 0;
            const double h = rock ? 2.0 * d.radius[i] : height(i);
            d.y[i] = rock ? top - 0.5 * h : top + 0.5 * h;
            if (!rock) {
                d.radius[i] = std::sqrt(h * width_ / pi);
                top += i % columns + 1 == columns ? h : 0.0;
            }
        }
        return top;
    }

    void lay_down() {
        const double room = -place();
        const std::size_t first = add_discs(state_, columns);
        const DiscColumns d = disc_columns(state_);
        for (std::size_t c = 0; c < columns; ++c) {
            const std::size_t i = first + c;
            d.x[i] = (static_cast<double>(c) + 0.5) * width_;
            d.mass[i] = 2600.0 * (1.0 - fresh) * room * width_;
            d.stratum[i] = solved_ / every_;
            d.start_travel[i] = state_.clock.travel.m;
            d.material[i] = dem::sediment;
        }
    }

    double rate_;
    int every_;
    double width_; ///< of a disc's column, m
    RigidBase base_;
    PoreFluid event_;
    State state_;
    int solved_ = 0;
};

void expect_near(double found, double exact, const std::string& where) {
    EXPECT_NEAR(found, exact, std::min(0.015, 0.15 * exact)) << where;
}

void expect_continuous(double permeability, double rate, double years, std::span<const double> at) {
    const auto exact = laid_down_continuously(permeability, rate, years);
    for (const double between_strata : {2500.0, 5000.0, 10000.0}) {
        DiscColumn column(permeability, rate, between_strata);
        column.sink_to(years);
        const auto found = column.profile();
        for (const double depth : at)
            expect_near(
                at_depth(found, depth), at_depth(exact, depth),
                fmt::format("{}, {}, every {} a, {}", permeability, rate, between_strata, depth));
    }
}

TEST(PoreStrata, PressureDoesNotDependOnTheirTime) {
    for (const double permeability : {1e-18, 3e-18, 3e-17})
        expect_continuous(permeability, 7.5e-3, 6e5, depths);
}

TEST(PoreStrata, NorAtAnotherRate) {
    const double shallow[] = {500.0, 1000.0};
    expect_continuous(3e-19, 1.5e-3, 1e6, shallow);
}

TEST(PoreStrata, NorOnTheMoment) {
    // Between two strata: just after one, half-way, just before and at the next.
    for (const double years : {592500.0, 595000.0, 597500.0, 600000.0}) {
        const auto exact = laid_down_continuously(3e-17, 7.5e-3, years);
        DiscColumn column(3e-17, 7.5e-3, 10000.0);
        column.sink_to(years);
        for (const double depth : depths)
            expect_near(at_depth(column.profile(), depth), at_depth(exact, depth),
                        fmt::format("{} a, {}", years, depth));
    }
}

} // namespace
} // namespace listric::pore_strata_test
