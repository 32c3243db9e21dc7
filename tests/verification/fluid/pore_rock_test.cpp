// Rock before extension that water flows through: mud on it against a closed form, pressure that it
// hands sideways, and what that pressure does to discs.

#include "dem/base/ground_level.hpp"
#include "dem/columns.hpp"
#include "fluid/columns.hpp"
#include "fluid/pore_fluid.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace listric::pore_rock_test {

using namespace dem;
using namespace fluid;
namespace {

using namespace support;

constexpr double year = 31557600.0, viscosity = 5e-4, water = 4.4e-10, density = 2600.0;
constexpr double porosity = 0.5, decay = 1e-6; // of mud that hardly differs with depth
constexpr double grain_weight = (density - 1030.0) * standard_gravity;

/// Square lattice of discs, from the floor up, in a box. Rows below `rock` are porous rock; above
/// it there is mud left of the column `mud`, and rock that nothing flows through right of it.
struct Lattice {
    int columns, rows, rock, mud;
    double radius;
    PorousRock kind;
    double mud_permeability, start; ///< m^2; of the pressure of mud, Pa
    bool drains = true;             ///< the rock

    bool is_rock(int row) const { return row < rock; }
    RigidBase base() const { return box(2.0 * radius * columns, 4.0 * radius * rows); }

    State state() const {
        std::vector<Disc> discs;
        for (int n = 0; n < columns * rows; ++n)
            discs.push_back(
                {2.0 * radius * (0.5 + n % columns), 2.0 * radius * (0.5 + n / columns), radius});
        State state = make_state(discs);
        const DiscColumns d = disc_columns(state);
        const auto layer = state.discs.add(dem::columns::layer);
        const auto pores = state.discs.add(dem::columns::porosity);
        for (int n = 0; n < columns * rows; ++n) {
            const auto i = static_cast<std::size_t>(n);
            const bool is_mud = !is_rock(n / columns) && n % columns < mud;
            d.stratum[i] = is_mud ? 1 : 0;
            layer[i] = is_rock(n / columns) ? 1 : 0;
            pores[i] = is_mud ? porosity : 0.0;
            d.mass[i] = density * 4.0 * radius * radius * (1.0 - pores[i]);
        }
        return state;
    }

    PoreFluid fluid(double interval) const {
        PoreFluidParameters p;
        p.interval = interval;
        p.flow.permeability = {PermeabilityLaw::constant, mud_permeability};
        WetSediment s;
        s.surface_porosity = porosity;
        s.porosity_decay = decay;
        if (drains)
            s.rocks = {kind};
        return {p, s, standard_gravity, 0.01};
    }

    /// After some solutions; mud begins with its pressure.
    State after(int solutions, double interval) const {
        State state = this->state();
        PoreFluid event = fluid(interval);
        event.begin(state);
        const PoreLaw law{porosity, decay, grain_weight, water};
        const GroundLevel ground(state);
        const DiscColumns d = disc_columns(state);
        const auto u = state.discs.get(dem::columns::excess_pressure);
        const auto held = state.discs.get(fluid::columns::pore_water);
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (d.stratum[i] > 0) {
                u[i] = start;
                const double grains = (1.0 - porosity) * ground.depth({d.x[i], d.y[i]});
                held[i] = d.mass[i] / density * void_ratio(law, grains, 0.0, start).value *
                          (1.0 + water * start);
            }
        for (int n = 0; n < solutions; ++n) {
            event.apply(state, base());
            ++event.applied;
        }
        came = event.remembered(PoreFluid::Sums::came);
        left = event.remembered(PoreFluid::Sums::left);
        gone = event.remembered(PoreFluid::Sums::surface) +
               event.remembered(PoreFluid::Sums::vented) +
               event.remembered(PoreFluid::Sums::eroded);
        return state;
    }

    mutable double came = 0.0, left = 0.0, gone = 0.0;
};

// ---- two layers

/// What conducts heat as pressure here: diffusivity, conductivity and thickness.
struct Layer {
    double diffusivity, conductivity, thickness;
    double phase(double rate) const { return rate * thickness / std::sqrt(diffusivity); }
    double effusivity() const { return conductivity / std::sqrt(diffusivity); }
};

/// Two layers, the lower one closed below and without pressure at first, the upper one at 1 and
/// drained above: sum of eigenfunctions exp(-rate^2 t) [Carslaw & Jaeger].
double two_layers(const Layer& lower, const Layer& upper, double height, double time) {
    const auto characteristic = [&](double rate) {
        return lower.effusivity() * std::sin(lower.phase(rate)) * std::sin(upper.phase(rate)) -
               upper.effusivity() * std::cos(lower.phase(rate)) * std::cos(upper.phase(rate));
    };
    // Far more often than it changes its sign.
    const double step = 0.02 * pi / (lower.phase(1.0) + upper.phase(1.0));
    double sum = 0.0;
    for (int k = 0, found = 0; found < 200; ++k) {
        double from = k * step + 1e-9 * step, to = from + step;
        if (characteristic(from) * characteristic(to) > 0.0)
            continue;
        ++found;
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = 0.5 * (from + to);
            (characteristic(from) * characteristic(middle) <= 0.0 ? to : from) = middle;
        }
        const double rate = 0.5 * (from + to), a = lower.phase(rate), b = upper.phase(rate);
        const double k1 = rate / std::sqrt(lower.diffusivity);
        const double k2 = rate / std::sqrt(upper.diffusivity);
        const double s1 = lower.conductivity / lower.diffusivity;
        const double s2 = upper.conductivity / upper.diffusivity;
        const double norm = s1 * std::pow(std::sin(b), 2) *
                                (0.5 * lower.thickness + std::sin(2.0 * a) / (4.0 * k1)) +
                            s2 * std::pow(std::cos(a), 2) *
                                (0.5 * upper.thickness - std::sin(2.0 * b) / (4.0 * k2));
        const double begins = s2 * std::cos(a) * (1.0 - std::cos(b)) / k2;
        const double shape =
            height < lower.thickness
                ? std::sin(b) * std::cos(k1 * height)
                : std::cos(a) * std::sin(k2 * (lower.thickness + upper.thickness - height));
        sum += begins / norm * shape * std::exp(-rate * rate * time);
    }
    return sum;
}

TEST(PoreRock, MudDrainsIntoItAsTwoLayersDo) {
    constexpr double interval = 100.0;
    const Lattice lattice{3, 80, 32, 3, 12.5, {.porosity = 0.1}, 1e-19, 1e5};
    for (const double permeability : {1e-19, 3e-18}) {
        Lattice one = lattice;
        one.kind.flow.permeability.at_fifth = permeability;
        const double of_rock = 0.1 * water + one.kind.compressibility; // stored by 1 Pa
        const double of_mud =
            decay * porosity / (grain_weight * std::pow(1.0 - porosity, 2)) + porosity * water;
        const State start = one.state();
        const double floor = 2.0 * one.radius * one.rock;
        const double top = GroundLevel(start).height(37.5);
        const Layer rock{permeability / viscosity / of_rock, permeability / viscosity, floor};
        const Layer mud{1e-19 / viscosity / of_mud, 1e-19 / viscosity, top - floor};
        for (const int solutions : {100, 400}) {
            const State state = one.after(solutions, interval);
            const ConstDiscColumns d = disc_columns(state);
            const auto u = state.discs.get(dem::columns::excess_pressure);
            const double time = solutions * interval * year;
            for (std::size_t i = 0; i < d.x.size(); i += 3)
                EXPECT_NEAR(u[i] / one.start, two_layers(rock, mud, d.y[i], time), 0.01)
                    << permeability << ", " << solutions << ", " << d.y[i];
            EXPECT_GT(two_layers(rock, mud, 0.0, time), 0.05); // it has got there
            EXPECT_NEAR(one.left + one.gone, one.came, 1e-12 * one.left);
        }
    }
}

// ---- sideways

TEST(PoreRock, HandsPressureSideways) {
    // Mud on the left third of an aquifer of 6 km, rock that nothing flows through on the rest.
    Lattice lattice{60, 16, 4, 20, 50.0, {.porosity = 0.1}, 1e-17, 2e5};
    lattice.kind.flow.permeability.at_fifth = 1e-13;
    const State state = lattice.after(20, 25.0);
    const auto u = state.discs.get(dem::columns::excess_pressure);
    const auto held = state.discs.get(fluid::columns::pore_water);
    const double foot = u[0], far = u[59];
    EXPECT_GT(far, 0.3 * lattice.start);
    EXPECT_NEAR(far, foot, 0.01 * foot);
    // What rock has taken up is its storage.
    const double volume = 1e4, storage = 0.1 * water + lattice.kind.compressibility;
    double taken = 0.0, pressures = 0.0;
    for (std::size_t i = 0; i < 240; ++i) {
        taken += held[i] - 0.1 * volume;
        pressures += u[i];
    }
    EXPECT_NEAR(taken, volume * storage * pressures, 1e-3 * taken);
    // It lifts the rock above, on 40 discs of 100 m.
    const auto push = state.discs.get(dem::columns::push_y);
    double lift = 0.0;
    for (std::size_t i = 4 * 60; i < push.size(); ++i)
        if (i % 60 >= 20)
            lift += push[i];
    EXPECT_NEAR(lift, 40 * 100.0 * far, 0.02 * lift);
    // Without it there is nothing of all that.
    lattice.drains = false;
    const State tight = lattice.after(20, 25.0);
    EXPECT_FALSE(tight.discs.has(fluid::columns::start_grains));
    for (std::size_t i = 0; i < 240; ++i)
        EXPECT_EQ(tight.discs.get(dem::columns::excess_pressure)[i], 0.0);
}

TEST(PoreRock, IsLiftedByItsVolumeTimesTheGradient) {
    const GenesisRequest request = packing_request(4000.0, 4000.0, 50.0);
    State state = settled(request);
    std::ranges::fill(state.discs.add(dem::columns::layer), std::uint8_t{1});
    state.discs.add(dem::columns::porosity);
    Lattice lattice{};
    lattice.kind = {.porosity = 0.2};
    lattice.kind.flow.permeability.at_fifth = 1e-22;
    PoreFluid event = lattice.fluid(1e-3);
    event.begin(state);
    const double slope = 0.4 * grain_weight;
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    const auto u = state.discs.get(dem::columns::excess_pressure);
    const auto held = state.discs.get(fluid::columns::pore_water);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        u[i] = -slope * d.y[i];
        held[i] =
            d.mass[i] / density * rock_pores(lattice.kind, 0.0, u[i]).value * (1.0 + water * u[i]);
    }
    event.apply(state, request.base);
    const auto push = state.discs.get(dem::columns::push_y);
    int inside = 0;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (std::abs(d.x[i] - 2000.0) < 1500.0 && std::abs(d.y[i] + 2000.0) < 1500.0) {
            ++inside;
            EXPECT_NEAR(push[i], d.mass[i] / density * slope, 1e-4 * push[i]);
        }
    EXPECT_GT(inside, 500);
}

TEST(PoreRock, PressureChangesInWhatConductsLess) {
    // Two rows of rock, two of mud and one above; a jump of pressure from rock to mud.
    const Lattice lattice{5, 5, 2, 5, 50.0, {.porosity = 0.1}, 1e-19, 0.0};
    WetSediment sediment;
    sediment.rocks = {lattice.kind};
    const State state = lattice.state();
    PoreCells cells = pore_cells(state, lattice.base(), sediment);
    std::vector<double> u(cells.count(), 1e5);
    cells.permeability.assign(cells.count(), 3e-19);
    for (std::size_t k = 0; k < 10; ++k) {
        u[k] = 0.0;
        cells.permeability[k] = 9e-19;
    }
    // As much of it in either as flow has it: 1/4 and 3/4, over cells of 100 m.
    const std::vector<Point> gradients = pressure_gradients(cells, u);
    EXPECT_NEAR(gradients[7].y, 250.0, 1e-9);
    EXPECT_NEAR(gradients[12].y, 750.0, 1e-9);
    EXPECT_NEAR(gradients[2].y, 0.0, 1e-9);
}

TEST(PoreRock, LoadOnItRaisesItsPressureAndNoneIsLeftWhereItDrains) {
    const PorousRock rock{.porosity = 0.1, .compressibility = 1e-10};
    // Pores under a load whose pressure has risen by as much are as they were.
    EXPECT_EQ(rock_pores(rock, 5e6, 5e6).value, 0.1);
    EXPECT_NEAR(rock_pores(rock, 1e6, 0.0).value, 0.1 - 1e-4, 1e-7);
    EXPECT_DOUBLE_EQ(rock_pores(rock, -1e6, 0.0).value, 0.1 + 1e-4);
    EXPECT_GT(rock_pores(rock, 1e10, 0.0).value, 0.0);
    for (const double u : {-3e6, 4e6, 9e6}) {
        constexpr double step = 10.0;
        const double slope =
            (rock_pores(rock, 4e6, u + step).value - rock_pores(rock, 4e6, u - step).value) /
            (2.0 * step);
        EXPECT_NEAR(rock_pores(rock, 4e6, u).slope, slope, 1e-3 * slope) << u;
    }
}

} // namespace
} // namespace listric::pore_rock_test
