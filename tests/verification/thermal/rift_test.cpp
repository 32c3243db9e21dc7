// McKenzie's subsidence after rifting, from the points below a stretched section: what
// their temperatures take from it loads a column of mantle under water. Crust, which has another
// heat capacity, is as thin as it can be.

#include "dem/columns.hpp"
#include "tests/support.hpp"
#include "tests/verification/thermal/sections.hpp"
#include "thermal/columns.hpp"
#include "thermal/heat.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace listric::rift_test {

using namespace dem;
using namespace thermal;
namespace {

constexpr double depth = 150.0, length = 2e3, radius = 75.0, width = 400e3;
constexpr double mantle = 3330.0, water = 1000.0;

/// A rift of a factor beta in some years, and steps of 10 Ma of rest after it.
struct Rift {
    State state = support::rows_of_discs(length, depth, radius);
    RigidBase base;
    HeatPoints points;
    Heat heat;

    Rift(double beta, double years, int parts)
        : points(parameters(), setting(beta), schedule(beta, years, parts)),
          heat(parameters(), setting(beta), points, schedule(beta, years, parts)) {
        const double extension = (beta - 1.0) * width;
        base.surfaces = {{"floor", {line({0.0, -depth}, {length, -depth})}},
                         {"right wall", {line({length, -depth}, {length, 1e4})}}};
        base.motion.stages = {
            {Travel(0.0), Travel(extension), Extension(0.0), 1.0},
            {Travel(extension), Travel(extension + 1e5), Extension(extension), 0.0}};
        heat.begin(state);
        points.start(state, base);
        heat.start(state, base);
        for (int k = 0; k < parts; ++k)
            step();
    }

    static HeatParameters parameters() {
        HeatParameters p;
        p.surface_temperature = 0.0;
        p.crust = depth;
        p.conductivity = p.mantle_conductivity = 0.8e-6 * mantle_capacity;
        p.heat_production = 0.0;
        return p;
    }
    static HeatSetting setting(double beta) {
        HeatSetting s;
        s.beside = {0.0, 0.0, length};
        s.greatest_extension = (beta - 1.0) * width;
        s.shear = {-450e3, width, width};
        s.rock_densities = {2600.0};
        s.mantle_density = mantle;
        return s;
    }
    static Schedule schedule(double beta, double years, int parts) {
        const double extension = (beta - 1.0) * width;
        const SteppedPause pause{Travel(extension), Travel(100.0), 10, 10e6};
        return {years / parts, Calendar(extension / years, {pause}), InSteps::once};
    }

    /// Subsidence of the middle since the rift ended, after each step, m.
    std::vector<double> subsidence() {
        const double start = uplift();
        std::vector<double> all;
        for (int k = 0; k < 10; ++k) {
            step();
            all.push_back(start - uplift());
        }
        return all;
    }

    void step() {
        for (Event* const event : {static_cast<Event*>(&points), static_cast<Event*>(&heat)}) {
            state.clock.travel = event->next_due();
            state.clock.extension = base.motion.position(state.clock.travel);
            event->apply(state, base);
            ++event->applied;
        }
    }

    /// Uplift of the middle, in its water, m: a mean whose weights rise from nothing and fall
    /// again, for heat goes sideways where stretching ends.
    double uplift() const {
        constexpr double left = -400e3, strip = 10e3;
        constexpr int strips = 36;
        std::vector<double> knots;
        for (int k = 0; k <= strips; ++k)
            knots.push_back(left + k * strip);
        const std::vector<double> lost = heat.mass_lost(state, base, knots);
        double mean = 0.0;
        for (int k = 0; k <= strips; ++k)
            mean += lost[static_cast<std::size_t>(k)] / strips *
                    (1.0 - std::cos(2.0 * std::numbers::pi * k / strips));
        return mean / (mantle - water);
    }
};

/// Less comes up than in McKenzie's column: rock above the detachment does not stretch.
constexpr double share = (1.0 - depth / 125e3) * (1.0 - depth / 125e3);

// Parts of steps of 0.25 Ma are 0.2 % late at 20 Ma, and rows at the foot of the stretched rock are
// 3 to 6 km high.
TEST(Rift, SubsidesAsMcKenzieSays) {
    for (const auto& [beta, expected] : {std::pair{1.25, std::array{240.0, 448.0, 631.0}},
                                         std::pair{1.5, std::array{350.0, 712.0, 1036.0}},
                                         std::pair{2.0, std::array{492.0, 1045.0, 1544.0}},
                                         std::pair{5.0, std::array{961.6, 1790.0, 2523.3}}}) {
        Rift rift(beta, 1e3, 1);
        const std::vector<double> found = rift.subsidence();
        EXPECT_NEAR(found[1] / (share * expected[0]), 1.0, 0.007) << beta << ", 20 Ma";
        EXPECT_NEAR(found[4] / (share * expected[1]), 1.0, 0.005) << beta << ", 50 Ma";
        EXPECT_NEAR(found[9] / (share * expected[2]), 1.0, 0.005) << beta << ", 100 Ma";
        EXPECT_NEAR(rift.heat.balance_error(), 0.0, 1e-10);
        for (const double t : rift.points.get<double>(HeatPoints::Columns::temperature)) {
            EXPECT_GE(t, 0.0);
            EXPECT_LE(t, 1333.0 + 1e-9);
        }
    }
}

TEST(Rift, LosesHeatWhileItOpens) {
    for (const auto& [beta, expected] :
         {std::pair{1.25, 550.0}, std::pair{1.5, 942.0}, std::pair{2.0, 1442.0}}) {
        Rift rift(beta, 10e6, 20);
        EXPECT_NEAR(rift.subsidence().back() / (share * expected), 1.0, 0.01) << beta;
        EXPECT_NEAR(rift.heat.balance_error(), 0.0, 1e-10);
    }
}

/// Pure shear keeps areas: what comes at the floor is what the walls draw out.
TEST(Rift, KeepsItsArea) {
    for (const double beta : {1.03, 1.25, 1.5, 2.0}) {
        Rift rift(beta, 1e3, 1);
        double area = 0.0;
        for (const double one : rift.points.get<double>(HeatPoints::Columns::area))
            area += one;
        const SectionEnds ends = rift.points.ends();
        const double all = (ends.right - ends.left) * -ends.floor - length * depth;
        EXPECT_NEAR(area / all, 1.0, 0.01) << beta; // half a cell at the floor
    }
}

} // namespace
} // namespace listric::rift_test
