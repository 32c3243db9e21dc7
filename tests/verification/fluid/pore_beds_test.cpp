// Sediment of more than one kind, and beds that conduct along better than across: a sand between
// muds against a solution that shares no code, an aquifer that hands pressure up its dip, and
// Darcy's flow through tilted beds against the exact tensor.

#include "fluid/pore_column.hpp"
#include "fluid/pore_fluid.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace listric::pore_beds_test {

using namespace dem;
using namespace fluid;
namespace {

using namespace support;

constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- beds that are tilted

/// A packing in a box of 40 by 40 diameters whose beds dip; they are `thick` m, or nothing.
State tilted(double dip, double thick) {
    static const State settled_once = settled(packing_request(4000.0, 4000.0, 50.0));
    State state = settled_once;
    state.clock.travel = Travel(1e4);
    const DiscColumns d = disc_columns(state);
    std::ranges::fill(d.stratum, 1);
    const double s = std::sin(dip * pi / 180.0), c = std::cos(dip * pi / 180.0);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double across = d.y[i] * c - d.x[i] * s;
        d.start_travel[i] = thick > 0.0 ? thick * std::floor(across / thick) : across;
    }
    return state;
}

/// What leaves the inner part of the box over what a tensor lets leave, for pressures along^2,
/// across^2 (over that of along^2) and along times across (which should be 0, over the same).
std::vector<double> flows(double dip, double ratio, double thick) {
    const State state = tilted(dip, thick);
    const PoreCells cells = pore_cells(state, packing_request(4000.0, 4000.0, 50.0).base);
    const std::vector<double> k(cells.count(), 1.0);
    const Bedding beds = bedding(state, cells, std::vector<double>(k.size(), ratio));
    const FlowNetwork network = flow_network(state, cells, k, 1.0, {}, beds);
    const ConstDiscColumns d = disc_columns(state);
    const double s = std::sin(dip * pi / 180.0), c = std::cos(dip * pi / 180.0);
    const auto flow_by = [&](auto&& pressure) {
        double leaves = 0.0, area = 0.0;
        const auto at = [&](std::size_t cell) {
            const auto i = static_cast<std::size_t>(cells.rows[cell]);
            return Point{d.x[i] - 2000.0, d.y[i] + 2000.0};
        };
        const auto is_inside = [&](std::size_t cell) {
            return std::abs(at(cell).x) < 1500.0 && std::abs(at(cell).y) < 1500.0;
        };
        const auto u = [&](std::size_t cell) {
            const Point p = at(cell);
            return pressure(p.x * c + p.y * s, p.y * c - p.x * s);
        };
        for (std::size_t cell = 0; cell < cells.count(); ++cell)
            area += is_inside(cell) ? cells.faceted.cells[cell].area : 0.0;
        for (const auto& [first, second, conductance] : network.links) {
            const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
            if (is_inside(i) != is_inside(j))
                leaves += (is_inside(i) ? -1.0 : 1.0) * conductance * (u(i) - u(j));
        }
        return leaves / area;
    };
    return {flow_by([](double along, double) { return along * along; }) / (2.0 * ratio),
            flow_by([](double, double across) { return across * across; }) / 2.0,
            flow_by([](double along, double across) { return along * across; }) / ratio};
}

TEST(PoreBeds, FlowIsThatOfTheTensor) {
    for (const double dip : {0.0, 20.0, 45.0, 70.0, 90.0})
        for (const double ratio : {10.0, 0.1}) {
            const std::vector<double> found = flows(dip, ratio, 0.0);
            EXPECT_NEAR(found[0], 1.0, 0.02) << dip << ", " << ratio;
            EXPECT_NEAR(found[1], 1.0, 0.02) << dip << ", " << ratio;
            EXPECT_NEAR(found[2], 0.0, 0.02) << dip << ", " << ratio;
        }
}

/// Beds are then told from ages in steps: some 4 degrees of scatter, which leaks across.
TEST(PoreBeds, FlowIsThatOfTheTensorThoughStrataAreAsThickAsDiscs) {
    for (const double dip : {0.0, 20.0, 45.0, 70.0, 90.0}) {
        const std::vector<double> found = flows(dip, 10.0, 100.0);
        EXPECT_NEAR(found[0], 1.0, 0.02) << dip;
        EXPECT_NEAR(found[1], 1.0, 0.05) << dip;
        EXPECT_NEAR(found[2], 0.0, 0.03) << dip;
    }
}

/// What flows up through level beds, by what would if they were alike in all directions.
double leak(double ratio) {
    const State state = tilted(0.0, 100.0);
    const PoreCells cells = pore_cells(state, packing_request(4000.0, 4000.0, 50.0).base);
    const ConstDiscColumns d = disc_columns(state);
    std::vector<double> k(cells.count(), 1.0);
    PressureBounds bounds{std::vector<double>(k.size(), -infinity),
                          std::vector<double>(k.size(), infinity)};
    for (std::size_t cell = 0; cell < k.size(); ++cell) {
        const double y = d.y[static_cast<std::size_t>(cells.rows[cell])];
        if (y < -3800.0 || y > -200.0)
            bounds.lowest[cell] = bounds.highest[cell] = y < -3800.0 ? 1e9 : 0.0;
    }
    const Storage storage = [](std::size_t, double pressure) { return Stored{pressure, 1.0}; };
    const auto flux = [&](double of_ratio) {
        const Bedding beds = bedding(state, cells, std::vector<double>(k.size(), of_ratio));
        const FlowNetwork network = flow_network(state, cells, k, 1.0, {}, beds);
        std::vector<double> u(k.size(), 0.0), water(k.size(), 0.0);
        EXPECT_FALSE(flow(network, storage, bounds, 1e20, water, u).stuck);
        double up = 0.0;
        for (const auto& [first, second, conductance] : network.links) {
            const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
            if ((bounds.highest[i] == 1e9) != (bounds.highest[j] == 1e9))
                up += (bounds.highest[i] == 1e9 ? 1.0 : -1.0) * conductance * (u[i] - u[j]);
        }
        return up;
    };
    return flux(ratio) / flux(1.0);
}

TEST(PoreBeds, LeakAcrossByLessThanAQuarterUpToTheRatioThatIsWarnedOf) {
    // Found: 1.009, 1.027, 1.076, 1.227; 3.6 at 1e6.
    const std::pair<double, double> most[] = {
        {10.0, 1.02}, {100.0, 1.05}, {1000.0, 1.12}, {greatest_tight_ratio, 1.25}};
    for (const auto& [ratio, bound] : most) {
        const double found = leak(ratio);
        EXPECT_GT(found, 1.0) << ratio;
        EXPECT_LT(found, bound) << ratio;
    }
}

// ---- an aquifer

TEST(PoreBeds, AnAquiferHandsPressureUpItsDip) {
    // Mud held at a pressure below and drained above, with a sand of another age that dips by 10
    // degrees. What comes into the sand from below is what leaves it upward: the centroid is where
    // mud beside it has its pressure.
    constexpr int columns = 120, rows = 50;
    constexpr double radius = 25.0, held = 1e7, half = 100.0;
    const double slope = std::tan(10.0 * pi / 180.0);
    const auto middle = [&](double x) { return 1250.0 + slope * (x - 3000.0); };
    std::vector<Disc> discs;
    for (int n = 0; n < columns * rows; ++n)
        discs.push_back(
            {2.0 * radius * (0.5 + n % columns), 2.0 * radius * (0.5 + n / columns), radius});
    State state = make_state(discs);
    std::ranges::fill(disc_columns(state).stratum, 1);
    const PoreCells cells = pore_cells(state, box(2.0 * radius * columns, 4.0 * radius * rows));
    const auto is_sand = [&](std::size_t i) {
        return std::abs(discs[i].y - middle(discs[i].x)) < half;
    };
    std::vector<double> k(cells.count(), 1.0), u(k.size(), 0.0), water(k.size(), 0.0);
    for (std::size_t i = 0; i < k.size(); ++i)
        if (is_sand(i))
            k[i] = 1e5;
    PressureBounds bounds{std::vector<double>(k.size(), -infinity),
                          std::vector<double>(k.size(), infinity)};
    for (std::size_t i = 0; i < columns; ++i)
        bounds.lowest[i] = bounds.highest[i] = held;
    const Storage storage = [](std::size_t, double pressure) { return Stored{pressure, 1.0}; };
    const FlowOutcome outcome =
        flow(flow_network(state, cells, k, 1.0), storage, bounds, 1e20, water, u);
    ASSERT_FALSE(outcome.stuck);
    double from_below = 0.0, upward = 0.0; // conductances
    for (double x = radius; x < 2.0 * radius * columns; x += 2.0 * radius) {
        from_below += 1.0 / (middle(x) - half - radius);
        upward += 1.0 / (2.0 * radius * rows - middle(x) - half);
    }
    const double balance = held * from_below / (from_below + upward);
    double foot = 0.0, crest = 0.0;
    for (std::size_t i = 0; i < k.size(); ++i)
        if (is_sand(i) && i % columns == 0)
            foot = u[i];
        else if (is_sand(i) && i % columns == columns - 1)
            crest = u[i];
    EXPECT_NEAR(foot, balance, 0.03 * balance);
    EXPECT_NEAR(crest, balance, 0.03 * balance);
    // Alone each would have that of its depth.
    EXPECT_LT(foot, 0.85 * held * (1.0 - (middle(0.0) - half) / (2.0 * radius * rows)));
}

// ---- a sand between muds

constexpr double year = 31557600.0, viscosity = 5e-4;
constexpr double weight = (2600.0 - 1030.0) * standard_gravity; // of grains in water, N/m^3

/// phi_0, decay, 1/m, permeability at a porosity of 0.2, m^2; until, a.
struct Kind {
    double fresh, decay, permeability, until;
};

const std::vector<Kind> sequence{
    {0.63, 5.1e-4, 1e-18, 2e5}, {0.49, 2.7e-4, 1e-14, 3.5e5}, {0.56, 3.9e-4, 3e-18, infinity}};
constexpr double rate = 7.5e-3, years = 6e5; // m/a
constexpr double depths[] = {500.0, 1000.0, 1500.0, 2500.0, 3500.0};

double at_depth(const std::map<double, double>& profile, double depth) {
    const auto below = profile.lower_bound(depth);
    if (below == profile.begin() || below == profile.end())
        return std::nan("");
    const auto above = std::prev(below);
    const double share = (depth - above->first) / (below->first - above->first);
    return above->second + share * (below->second - above->second);
}

/// Layers that come every step, by void ratio: Newton's method on all of them, with the whole
/// Jacobian of a tridiagonal system by differences.
class Layers {
public:
    explicit Layers(double step) : step_(step * year) {
        for (double age = step; age < years * (1.0 + 1e-9); age += step) {
            lay_down(age);
            settle();
        }
    }

    /// Excess pressure over the weight of grains in water, by depth.
    std::map<double, double> profile() const {
        std::map<double, double> ratios;
        double depth = 0.0, above = 0.0;
        for (std::size_t i = solid_.size(); i-- > 0;) {
            const double height = solid_[i] * (1.0 + e_[i]);
            const double load = weight * (above + 0.5 * solid_[i]);
            ratios[depth + 0.5 * height] = pressure(i, e_[i], load) / load;
            depth += height;
            above += solid_[i];
        }
        return ratios;
    }

private:
    const Kind& kind(std::size_t i) const { return sequence[kind_[i]]; }

    /// Stress that a void ratio stands for, from the depth of a column at rest.
    double pressure(std::size_t i, double e, double load) const {
        const double porosity = e / (1.0 + e),
                     z = -std::log(porosity / kind(i).fresh) / kind(i).decay;
        return load - weight * (z - (kind(i).fresh - porosity) / kind(i).decay);
    }

    /// Resistance of half a layer, over its width.
    double resistance(std::size_t i, double e) const {
        const double porosity = e / (1.0 + e);
        const double k = kind(i).permeability * std::pow(porosity, 3) /
                         std::pow(1.0 - porosity, 2) / (0.008 / 0.64);
        return 0.5 * solid_[i] * (1.0 + e) * viscosity / k;
    }

    void lay_down(double age) {
        double height = 0.0;
        for (std::size_t i = 0; i < solid_.size(); ++i)
            height += solid_[i] * (1.0 + e_[i]);
        std::size_t of = 0;
        while (age > sequence[of].until * (1.0 + 1e-9))
            ++of;
        kind_.push_back(of);
        solid_.push_back((rate * age - height) *
                         (1.0 - kind(of == 0 ? 0 : kind_.size() - 1).fresh));
        e_.push_back(sequence[of].fresh / (1.0 - sequence[of].fresh));
    }

    std::vector<double> missing(const std::vector<double>& e, const std::vector<double>& before,
                                const std::vector<double>& load) const {
        std::vector<double> out(e.size());
        for (std::size_t i = 0; i < e.size(); ++i)
            out[i] = solid_[i] * (e[i] - before[i]);
        for (std::size_t i = 0; i < e.size(); ++i) {
            const bool top = i + 1 == e.size();
            const double u = pressure(i, e[i], load[i]);
            const double beyond = top ? 0.0 : pressure(i + 1, e[i + 1], load[i + 1]);
            const double q = (u - beyond) / (resistance(i, before[i]) +
                                             (top ? 0.0 : resistance(i + 1, before[i + 1])));
            out[i] += step_ * q;
            if (!top)
                out[i + 1] -= step_ * q;
        }
        return out;
    }

    void settle() {
        const std::size_t n = e_.size();
        std::vector<double> load(n);
        double above = 0.0;
        for (std::size_t i = n; i-- > 0; above += solid_[i])
            load[i] = weight * (above + 0.5 * solid_[i]);
        const std::vector<double> before = e_;
        for (int newton = 0; newton < 40; ++newton) {
            const std::vector<double> now = missing(e_, before, load);
            constexpr double moved = 1e-7;
            std::vector<double> lower(n), middle(n), upper(n);
            for (std::size_t colour = 0; colour < 3; ++colour) {
                std::vector<double> e = e_;
                for (std::size_t i = colour; i < n; i += 3)
                    e[i] -= moved;
                const std::vector<double> then = missing(e, before, load);
                for (std::size_t i = 0; i < n; ++i) {
                    const std::size_t of = (i + 3 - colour) % 3;
                    (of == 0 ? middle : of == 1 ? lower : upper)[i] = (now[i] - then[i]) / moved;
                }
            }
            std::vector<double> right = now;
            for (std::size_t i = 1; i < n; ++i) {
                middle[i] -= lower[i] / middle[i - 1] * upper[i - 1];
                right[i] -= lower[i] / middle[i - 1] * right[i - 1];
            }
            double greatest = 0.0, change = 0.0;
            for (std::size_t i = n; i-- > 0;) {
                change = (right[i] - (i + 1 < n ? upper[i] * change : 0.0)) / middle[i];
                const double most = kind(i).fresh / (1.0 - kind(i).fresh);
                e_[i] = std::clamp(e_[i] - change, 1e-3, most);
                greatest = std::max(greatest, std::abs(change));
            }
            if (greatest < 1e-10)
                break;
        }
    }

    double step_;
    std::vector<std::size_t> kind_;
    std::vector<double> solid_, e_; ///< from the floor up
};

WetSediment wet(double between_strata, double above) {
    WetSediment s;
    s.surface = Target(above);
    s.deposition = {between_strata, 0.01};
    s.beds.deposition = s.deposition;
    for (const Kind& kind : sequence) {
        s.beds.list.push_back({kind.until, {kind.fresh, kind.decay}});
        s.flows.push_back({.permeability = {.at_fifth = kind.permeability}});
    }
    return s;
}

/// Rows of four discs, one a stratum, on a row of rock that sinks, as the event of a run has them.
std::map<double, double> of_discs(double between_strata) {
    constexpr int columns = 4;
    constexpr double interval = 2500.0;
    const double width = 0.25 * pi * 1.15 * rate * between_strata, mean = 2.0 / pi * width;
    RigidBase base;
    base.surfaces = {{"floor", {line({0.0, -2e4}, {width * columns, -2e4})}},
                     {"left", {line({0.0, 2e4}, {0.0, -2e4})}},
                     {"right", {line({width * columns, -2e4}, {width * columns, 2e4})}}};
    base.motion.speed = 1.0;
    PoreFluidParameters p;
    p.interval = interval;
    p.fracture_ratio = 1.0;
    PoreFluid event(p, wet(between_strata, WetGround::left_free * mean), standard_gravity, 0.01);
    std::vector<Disc> rock;
    for (int c = 0; c < columns; ++c)
        rock.push_back({(c + 0.5) * width, 0.0, mean});
    State state = make_state(rock);
    state.mean_radius = mean;
    state.discs.add<double>("porosity", "1", sequence.front().fresh);
    event.begin(state);
    const auto place = [&](double floor) {
        const DiscColumns d = disc_columns(state);
        double top = floor;
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const bool is_rock = d.stratum[i] == 0;
            const double solid = 1.0 - state.discs.get<double>("porosity")[i];
            const double h = is_rock ? 2.0 * d.radius[i] : d.mass[i] / 2600.0 / width / solid;
            d.y[i] = is_rock ? top - 0.5 * h : top + 0.5 * h;
            if (is_rock)
                continue;
            d.radius[i] = std::sqrt(h * width / pi);
            top += i % columns + 1 == columns ? h : 0.0;
        }
        return top;
    };
    const int every = static_cast<int>(std::lround(between_strata / interval));
    for (int n = 1; n * interval < years * (1.0 + 1e-9); ++n) {
        if (n > 1 && (n - 1) % every == 0) {
            const int stratum = (n - 1) / every;
            const double fresh = event.law(stratum).surface_porosity;
            const double room = -place(-rate * interval * (n - 1));
            const std::size_t first = add_discs(state, columns);
            const DiscColumns d = disc_columns(state);
            for (std::size_t i = first; i < first + columns; ++i) {
                d.x[i] = (static_cast<double>(i - first) + 0.5) * width;
                d.mass[i] = 2600.0 * (1.0 - fresh) * room * width;
                d.stratum[i] = stratum;
                d.start_travel[i] = state.clock.travel.m;
                d.material[i] = dem::sediment;
                state.discs.get<double>("porosity")[i] = fresh;
                state.discs.get<double>("wanted_porosity")[i] = fresh;
            }
        }
        state.clock.travel = Travel(0.01 * interval * n);
        place(-rate * interval * n);
        event.apply(state, base);
        ++event.applied;
        std::ranges::copy(state.discs.get<double>("wanted_porosity"),
                          state.discs.get<double>("porosity").begin());
    }
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    std::map<double, double> ratios;
    for (std::size_t i = columns; i < d.x.size(); i += columns)
        ratios[-d.y[i]] = state.discs.get<double>("overpressure_ratio")[i];
    return ratios;
}

TEST(PoreBeds, ASandBetweenMuds) {
    const auto fine = Layers(1000.0).profile(), coarse = Layers(2000.0).profile();
    const auto discs = of_discs(10000.0);
    MudColumn column;
    column.fracture_ratio = 1.0;
    column.law.grain_weight = weight;
    for (const Kind& kind : sequence)
        column.beds.push_back(
            {kind.until * year,
             {.surface_porosity = kind.fresh, .decay = kind.decay, .grain_weight = weight},
             {.at_fifth = kind.permeability}});
    const SteadyColumn explained = sink_steadily(column, rate * years, years * year);
    for (const double depth : depths) {
        const double limit = 2.0 * at_depth(fine, depth) - at_depth(coarse, depth);
        EXPECT_NEAR(at_depth(fine, depth), limit, 0.02) << depth; // steps alone
        EXPECT_NEAR(at_depth(discs, depth), limit, 0.02) << depth;
        EXPECT_NEAR(explained.at(depth).overpressure_ratio, limit, 0.02) << depth;
    }
}

} // namespace
} // namespace listric::pore_beds_test
