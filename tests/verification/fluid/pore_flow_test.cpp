// Flow of pore water between the cells of discs against exact solutions, and what holds of it
// whatever the pressures. Errors of the first kind are those of irregular cells some 1/16 or 1/32
// of the height wide; the others are round-off.

#include "fluid/pore_law.hpp"
#include "fluid/pore_network.hpp"
#include "tests/support.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace listric::pore_flow_test {

using namespace dem;
using namespace fluid;
namespace {

using namespace support;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A packing of sediment that genesis has settled in a box, cut by a plane through which it drains.
struct Mud {
    State state;
    RigidBase base;
    PoreCells cells;
    double height; ///< m

    explicit Mud(int discs_high, std::uint64_t seed = 1) {
        constexpr double radius = 50.0;
        height = 2.0 * radius * discs_high;
        const double depth = height + 6.0 * radius, width = 1.5 * height, top = -6.0 * radius;
        GenesisRequest request = packing_request(width, depth, radius);
        request.seed = seed;
        state = settled(request);
        std::vector<std::int32_t> below;
        for (std::size_t i = 0; i < state.discs.rows(); ++i)
            if (disc_columns(state).y[i] < top)
                below.push_back(static_cast<std::int32_t>(i));
        reorder_discs(state, below);
        std::ranges::fill(disc_columns(state).stratum, 1);
        base = request.base;
        base.surfaces.push_back({});
        cut(top);
    }

    /// Keeps some discs, and what is below a plane.
    void keep_below(std::span<const std::int32_t> rows, double top) {
        reorder_discs(state, rows);
        cut(top);
    }

    double area(std::size_t k) const { return cells.faceted.cells[k].area; }
    double floor() const { return base.surfaces.front().chain.front().start.y; }

    /// With drains through the plane.
    FlowNetwork network(std::span<const double> permeability) const {
        FlowNetwork flows = flow_network(state, cells, permeability, 1.0);
        for (std::size_t k = 0; k < cells.count(); ++k)
            for (const PowerFacet& f : cells.faceted.of(k))
                if (f.neighbour == facet_on_base && f.arm.y > 0.0 &&
                    std::abs(f.arm.y - cells.depths[k]) < 1e-6)
                    flows.drains[k] += permeability[k] * f.length / f.distance;
        return flows;
    }

private:
    void cut(double top) {
        const double width = 1.5 * height;
        base.surfaces.back() = {"plane", {line({2.0 * width, top}, {-width, top})}};
        cells = pore_cells(state, base); // no cell is open, so that none drains
        const ConstDiscColumns d = disc_columns(std::as_const(state));
        for (std::size_t k = 0; k < cells.count(); ++k)
            cells.depths[k] = top - d.y[k];
    }
};

PressureBounds unbounded(std::size_t cells) {
    return {std::vector<double>(cells, -infinity), std::vector<double>(cells, infinity)};
}

/// Terzaghi: pressure over that at the start, at depth z of h, drained at the top.
double terzaghi(double z_over_h, double time_factor) {
    double u = 0.0;
    for (int m = 0; m < 200; ++m) {
        const double a = 0.5 * pi * (2 * m + 1);
        u += 2.0 / a * std::sin(a * z_over_h) * std::exp(-a * a * time_factor);
    }
    return u;
}

/// Root of the mean square error of pressure at times T = 0.05, 0.2 and 0.5, over that at the
/// start.
std::vector<double> terzaghi_errors(int rows, int steps, std::uint64_t seed) {
    const Mud mud(rows, seed);
    const std::size_t n = mud.cells.count();
    constexpr double start = 1e7;
    const FlowNetwork network = mud.network(std::vector<double>(n, 1.0));
    const Storage storage = [&](std::size_t k, double u) {
        return Stored{mud.area(k) * u, mud.area(k)};
    };
    std::vector<double> u(n, start), water(n), errors;
    for (std::size_t k = 0; k < n; ++k)
        water[k] = storage(k, start).water;
    const double step = 0.5 * mud.height * mud.height / steps;
    for (int s = 1; s <= steps; ++s) {
        const FlowOutcome outcome = flow(network, storage, unbounded(n), step, water, u);
        EXPECT_FALSE(outcome.stuck);
        for (const double time : {0.05, 0.2, 0.5})
            if (s == std::lround(time / 0.5 * steps)) {
                double sum = 0.0;
                for (std::size_t k = 0; k < n; ++k) {
                    const double exact =
                        terzaghi(std::max(0.0, mud.cells.depths[k]) / mud.height, time);
                    sum += std::pow(u[k] / start - exact, 2);
                }
                errors.push_back(std::sqrt(sum / static_cast<double>(n)));
            }
    }
    return errors;
}

TEST(PoreFlow, Terzaghi) {
    // Seeds 1 and 2; an odd packing may have twice these errors.
    for (const std::uint64_t seed : {1, 2}) {
        const std::vector<double> coarse = terzaghi_errors(8, 2000, seed);
        const std::vector<double> fine = terzaghi_errors(16, 2000, seed);
        EXPECT_LT(fine[0], 0.003);
        EXPECT_LT(fine[1], 0.001);
        EXPECT_LT(fine[2], 0.001);
        EXPECT_GT(std::log2(coarse[0] / fine[0]), 1.8); // order in disc size
    }
}

/// Gibson (1958): pressure at the base over weight of grains in water, at T = m^2 t / c_v.
double gibson(double time_factor) {
    // With xi = 2 sqrt(c_v t) s: 1 - 2 / sqrt(pi T) * integral of 2 s tanh(sqrt(T) s) exp(-s^2).
    constexpr int steps = 20000;
    constexpr double end = 12.0, step = end / steps;
    double sum = 0.0;
    for (int k = 0; k <= steps; ++k) {
        const double s = k * step, weight = k == 0 || k == steps ? 1.0 : k % 2 ? 4.0 : 2.0;
        sum += weight * 2.0 * s * std::tanh(std::sqrt(time_factor) * s) * std::exp(-s * s);
    }
    return 1.0 - sum * step / 3.0 * 2.0 / std::sqrt(pi * time_factor);
}

TEST(PoreFlow, GibsonsIntegral) {
    // Its limits, and numbers that were read off it to 0.2 %.
    EXPECT_NEAR(gibson(1e-6), 0.0, 1e-6);
    EXPECT_NEAR(gibson(1e6), 1.0 - 2.0 / std::sqrt(pi * 1e6), 1e-6);
    EXPECT_NEAR(gibson(0.25), 0.1014, 0.0025 * 0.1014);
    EXPECT_NEAR(gibson(1.0), 0.2733, 0.0025 * 0.2733);
    EXPECT_NEAR(gibson(4.0), 0.5192, 0.0025 * 0.5192);
    EXPECT_NEAR(gibson(16.0), 0.7295, 0.0025 * 0.7295);
}

/// Base pressure of a packing that is laid down disc by disc in a time of 1, four steps a diameter.
double gibson_of_discs(const Mud& mud, double time_factor) {
    constexpr double diameter = 100.0, grain_weight = 15402.0, full = 1e9; // water a unit of area
    const double floor = mud.floor(), top = floor + mud.height;
    const double consolidation = mud.height * mud.height / time_factor; // c_v, m^2 per time
    const auto steps = static_cast<int>(4.0 * mud.height / diameter);
    const ConstDiscColumns all = disc_columns(mud.state);
    std::vector<double> u_of(all.x.size(), 0.0), water_of;
    for (std::size_t i = 0; i < all.x.size(); ++i)
        water_of.push_back(full * mud.area(i));
    for (int step = 1; step <= steps; ++step) {
        const double ground = floor + mud.height * step / steps;
        Mud laid = mud;
        std::vector<std::int32_t> rows;
        for (std::size_t i = 0; i < all.x.size(); ++i)
            if (all.y[i] < ground)
                rows.push_back(static_cast<std::int32_t>(i));
        if (rows.empty())
            continue;
        laid.keep_below(rows, std::min(ground, top));
        const std::size_t n = rows.size();
        std::vector<double> u(n), water(n), area(n);
        for (std::size_t k = 0; k < n; ++k) {
            const auto i = static_cast<std::size_t>(rows[k]);
            u[k] = u_of[i];
            water[k] = water_of[i];
            area[k] = mud.area(i);
        }
        const Storage storage = [&](std::size_t k, double pressure) {
            return Stored{area[k] * (full + pressure - grain_weight * laid.cells.depths[k]),
                          area[k]};
        };
        const FlowOutcome outcome = flow(laid.network(std::vector<double>(n, consolidation)),
                                         storage, unbounded(n), 1.0 / steps, water, u);
        EXPECT_FALSE(outcome.stuck);
        for (std::size_t k = 0; k < n; ++k) {
            u_of[static_cast<std::size_t>(rows[k])] = u[k];
            water_of[static_cast<std::size_t>(rows[k])] = water[k];
        }
    }
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < all.x.size(); ++i)
        if (all.y[i] < floor + diameter) {
            sum += u_of[i];
            count += 1.0;
        }
    return sum / count / (grain_weight * mud.height);
}

TEST(PoreFlow, GibsonDiscByDisc) {
    const Mud mud(32);
    for (const double time_factor : {0.25, 1.0, 4.0, 16.0})
        EXPECT_NEAR(gibson_of_discs(mud, time_factor), gibson(time_factor),
                    0.005 * gibson(time_factor))
            << time_factor;
}

TEST(PoreFlow, WangensCase) {
    // 1,000 m in 1 Ma [Wangen 2010, p. 403]: k 1.18e-18 m^2, E 64.62 MPa, nu 0.3, water of 1e-3 Pa
    // s.
    constexpr double height = 1000.0, seconds = 1e6 * 31557600.0, e = 64.62e6, nu = 0.3;
    const double stiffness = e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)); // of an oedometer
    const double consolidation = 1.18e-18 / 1e-3 * stiffness;                  // m^2/s
    const double time_factor = height * height / (consolidation * seconds);
    EXPECT_NEAR(gibson_of_discs(Mud(16), time_factor), gibson(time_factor),
                0.01 * gibson(time_factor));
}

TEST(PoreFlow, TwoLayersInSeries) {
    // Columns of a square lattice, the lower half a hundred times less permeable, held at a
    // pressure below and drained above. What the water keeps of the flow is 1e-18 of it.
    constexpr std::size_t columns = 6, rows = 10;
    constexpr double held = 1e6, radius = 50.0, seconds = 1e20;
    std::vector<Disc> discs;
    for (std::size_t k = 0; k < columns * rows; ++k)
        discs.push_back({2.0 * radius * (0.5 + static_cast<double>(k % columns)),
                         2.0 * radius * (0.5 + static_cast<double>(k / columns)), radius});
    State state = make_state(discs);
    std::ranges::fill(disc_columns(state).stratum, 1);
    const RigidBase walls = box(2.0 * radius * columns, 4.0 * radius * rows);
    const PoreCells cells = pore_cells(state, walls);
    std::vector<double> k(cells.count(), 1.0);
    std::fill_n(k.begin(), k.size() / 2, 0.01);
    const FlowNetwork network = flow_network(state, cells, k, 1.0);
    PressureBounds bounds = unbounded(k.size());
    for (std::size_t i = 0; i < columns; ++i)
        bounds.lowest[i] = bounds.highest[i] = held;
    std::vector<double> u(k.size(), 0.0), water(k.size(), 0.0);
    const Storage storage = [](std::size_t, double pressure) { return Stored{pressure, 1.0}; };
    const FlowOutcome outcome = flow(network, storage, bounds, seconds, water, u);
    ASSERT_FALSE(outcome.stuck);
    // From the lowest centres to the ground, a radius above the highest.
    const double resistance =
        (4.5 * 2.0 * radius / 0.01 + 5.0 * 2.0 * radius / 1.0) / (2.0 * radius * columns);
    EXPECT_NEAR(outcome.surface / seconds, held / resistance, 1e-12 * held / resistance);
}

/// A square lattice whose discs are as old as `age` says, 6 by 6, radius 50 m.
template <class Age> State lattice_of_age(Age&& age) {
    std::vector<Disc> discs;
    for (int k = 0; k < 36; ++k)
        discs.push_back({100.0 * (0.5 + k % 6), 100.0 * (0.5 + k / 6), 50.0});
    State state = make_state(discs);
    state.clock.travel = Travel(1000.0); // none of them is yet to come
    const DiscColumns d = disc_columns(state);
    std::ranges::fill(d.stratum, 1);
    for (std::size_t i = 0; i < discs.size(); ++i)
        d.start_travel[i] = age(d.x[i], d.y[i]);
    return state;
}

TEST(PoreFlow, FollowsTheBeds) {
    // Flow by a gradient along the beds and across, at any dip.
    constexpr double ratio = 5.0;
    const RigidBase walls = box(600.0, 2000.0);
    for (const double dip : {0.0, 30.0, 90.0, 150.0}) {
        const double s = std::sin(dip * pi / 180.0), c = std::cos(dip * pi / 180.0);
        const State state = lattice_of_age([&](double x, double y) { return y * c - x * s; });
        const PoreCells cells = pore_cells(state, walls);
        const Bedding beds = bedding(state, cells, std::vector<double>(cells.count(), ratio));
        const Point along = beds.flow_of(14, {c, s}), across = beds.flow_of(14, {-s, c});
        EXPECT_NEAR(along.x, ratio * c, 1e-9);
        EXPECT_NEAR(along.y, ratio * s, 1e-9);
        EXPECT_NEAR(across.x, -s, 1e-9);
        EXPECT_NEAR(across.y, c, 1e-9);
    }
}

TEST(PoreFlow, BedsAreLevelWhereAllIsEquallyOld) {
    const State state = lattice_of_age([](double, double) { return 0.0; });
    const PoreCells cells = pore_cells(state, box(600.0, 2000.0));
    for (const Point n : bedding(state, cells, std::vector<double>(36, 3.0)).normals) {
        EXPECT_EQ(n.x, 0.0);
        EXPECT_EQ(n.y, 1.0);
    }
    EXPECT_TRUE(bedding(state, cells, std::vector<double>(36, 1.0)).normals.empty());
}

TEST(PoreFlow, ExtremesNeverGrow) {
    const Mud mud(8);
    Random random(5);
    const std::size_t n = mud.cells.count();
    std::vector<double> k(n), u(n), water(n);
    for (std::size_t i = 0; i < n; ++i) {
        k[i] = std::pow(10.0, random.between(-3.0, 3.0));
        u[i] = random.between(-1e7, 1e7);
    }
    const Storage storage = [&](std::size_t i, double pressure) {
        return Stored{mud.area(i) * pressure, mud.area(i)};
    };
    for (std::size_t i = 0; i < n; ++i)
        water[i] = storage(i, u[i]).water;
    const FlowNetwork network = mud.network(k);
    const auto square = [&] { return std::inner_product(u.begin(), u.end(), u.begin(), 0.0); };
    const double before = square();
    auto [low, high] = std::ranges::minmax(u);
    for (int step = 0; step < 20; ++step) {
        flow(network, storage, unbounded(n), 1e5, water, u);
        const auto [lowest, highest] = std::ranges::minmax(u);
        EXPECT_GE(lowest, low - 1e-6); // round-off of 1e7
        EXPECT_LE(highest, high + 1e-6);
        low = lowest;
        high = highest;
    }
    EXPECT_LT(square(), 0.5 * before); // something has flown
}

TEST(PoreFlow, WhatIsBeyondTheBoundAtTheGroundIsNotVented) {
    const FlowNetwork network{{}, {0.0, 0.0}};
    const Storage storage = [](std::size_t, double u) { return Stored{u, 1.0}; };
    PressureBounds bounds{{-1.0, -1.0}, {1.0, 1.0}};
    bounds.at_ground = {false, true};
    std::vector<double> water{3.0, 6.0}, u{0.0, 0.0};
    const FlowOutcome outcome = flow(network, storage, bounds, 1.0, water, u);
    EXPECT_DOUBLE_EQ(outcome.vented, 2.0);
    EXPECT_DOUBLE_EQ(outcome.surface, 5.0);
}

TEST(PoreFlow, ForcesOfLinearPressure) {
    const Mud mud(12);
    const ConstDiscColumns d = disc_columns(mud.state);
    const Point gradient{3.0, -15402.0};
    std::vector<double> u(mud.cells.count());
    for (std::size_t k = 0; k < u.size(); ++k)
        u[k] = gradient.x * d.x[k] + gradient.y * d.y[k];
    const std::vector<Point> found = pressure_gradients(mud.cells, u);
    int inner = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
        const auto facets = mud.cells.faceted.of(k);
        if (std::ranges::any_of(facets, [](const PowerFacet& f) { return f.neighbour < 0; }))
            continue;
        ++inner;
        EXPECT_NEAR(found[k].x, gradient.x, 1e-12 * std::abs(gradient.y)) << k;
        EXPECT_NEAR(found[k].y, gradient.y, 1e-12 * std::abs(gradient.y)) << k;
    }
    EXPECT_GT(inner, 100);
}

TEST(PoreFlow, ForcesAddUpToThePressureAround) {
    // With the cells' areas as volumes: sum over the wet discs = minus the integral of u n over
    // where the wet end, which is what dry discs and walls get.
    Mud mud(12);
    const auto stratum = disc_columns(mud.state).stratum;
    for (std::size_t i = 0; i < stratum.size(); ++i)
        if (disc_columns(mud.state).x[i] > 1200.0)
            stratum[i] = 0;
    mud.cells = pore_cells(mud.state, mud.base);
    Random random(3);
    std::vector<double> u(mud.cells.count()), area;
    for (std::size_t k = 0; k < u.size(); ++k) {
        u[k] = random.between(0.0, 1e7);
        area.push_back(mud.cells.faceted.cells[k].area);
    }
    double fx = 0.0, fy = 0.0, size = 0.0;
    for (const Point& f : pore_forces(mud.state, mud.cells, area, u)) {
        fx += f.x;
        fy += f.y;
        size += std::abs(f.x) + std::abs(f.y);
    }
    const ConstDiscColumns d = disc_columns(std::as_const(mud.state));
    double wx = 0.0, wy = 0.0; // of the walls, floor and plane
    for (std::size_t k = 0; k < u.size(); ++k)
        for (const PowerFacet& f : mud.cells.faceted.of(k))
            if (f.neighbour == facet_on_base) {
                const auto i = static_cast<std::size_t>(mud.cells.rows[k]);
                const double on_side = std::abs(std::abs(f.arm.x) - f.distance);
                const double on_flat = std::abs(std::abs(f.arm.y) - f.distance);
                const Point n = on_side < on_flat ? Point{f.arm.x > 0.0 ? 1.0 : -1.0, 0.0}
                                                  : Point{0.0, f.arm.y > 0.0 ? 1.0 : -1.0};
                wx += u[k] * f.length * n.x;
                wy += u[k] * f.length * n.y;
                EXPECT_LT(std::min(on_side, on_flat), 1e-6) << d.x[i];
            }
    EXPECT_NEAR(fx + wx, 0.0, 1e-12 * size);
    EXPECT_NEAR(fy + wy, 0.0, 1e-12 * size);
}

} // namespace
} // namespace listric::pore_flow_test
