// Cases that are hard for Newton's method: whatever comes, pressure stays below the fracture line,
// no water is lost, and 20 steps are enough.

#include "fluid/pore_fluid.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace listric::pore_fluid_hard_test {

using namespace dem;
using namespace fluid;
namespace {

using namespace support;

/// 5 km of fresh mud, laid down at once.
State fresh_mud() {
    static const State settled_once = [] {
        State state = settled(packing_request(3000.0, 5000.0, 75.0));
        std::ranges::fill(disc_columns(state).stratum, 1);
        state.discs.add<double>("porosity", "1", 0.5);
        return state;
    }();
    return settled_once;
}

RigidBase walls() {
    RigidBase base = packing_request(3000.0, 5000.0, 75.0).base;
    base.motion.speed = 1.0;
    return base;
}

struct Case {
    std::string name;
    std::function<void(PoreFluidParameters&)> with = {};
    std::function<void(State&)> begin = {};
    std::function<void(State&)> after_ten = {};
};

std::vector<Case> hard_cases() {
    return {
        {"at once"},
        {"weak zone",
         [](PoreFluidParameters& p) {
             p.flow.faults = {1e6, 1e-6};
         },
         [](State& state) {
             const DiscColumns d = disc_columns(state);
             for (std::size_t i = 0; i < d.x.size(); ++i)
                 if (std::abs(d.x[i] - 1500.0 - 0.3 * (d.y[i] + 2500.0)) < 200.0)
                     d.material[i] = weak;
         }},
        {"half dry",
         {},
         [](State& state) {
             Random random(7);
             for (std::int32_t& stratum : disc_columns(state).stratum)
                 stratum = random.between(0.0, 1.0) < 0.5 ? 1 : 0;
         }},
        {"no rebound", [](PoreFluidParameters& p) { p.rebound = 0.0; }},
        {"fractures late", [](PoreFluidParameters& p) { p.fracture_ratio = 0.99; }},
        {"eroded",
         {},
         {},
         [](State& state) {
             std::vector<std::int32_t> kept;
             for (std::size_t i = 0; i < state.discs.rows(); ++i)
                 if (disc_columns(state).y[i] < -4000.0)
                     kept.push_back(static_cast<std::int32_t>(i));
             reorder_discs(state, kept);
         }},
    };
}

TEST(PoreFluidHard, ConvergesAndKeepsItsWater) {
    const RigidBase base = walls();
    for (const Case& c : hard_cases())
        for (const double permeability : {1e-12, 1e-14, 1e-16, 1e-17, 1e-18, 1e-19, 1e-20, 1e-22}) {
            PoreFluidParameters p;
            p.flow.permeability.at_fifth = permeability;
            if (c.with)
                c.with(p);
            State state = fresh_mud();
            if (c.begin)
                c.begin(state);
            PoreFluid event(p, {}, standard_gravity, 0.01);
            event.begin(state);
            for (int update = 0; update < 20; ++update) {
                if (c.after_ten && update == 10)
                    c.after_ten(state);
                ASSERT_NO_THROW(event.apply(state, base)) << c.name << ", " << permeability;
                ++event.applied;
            }
            const auto water = [&](const char* name) { return event.remembered(name); };
            using Sums = PoreFluid::Sums;
            EXPECT_NEAR(water(Sums::came),
                        water(Sums::surface) + water(Sums::vented) + water(Sums::eroded) +
                            water(Sums::left),
                        1e-13 * water(Sums::came))
                << c.name << ", " << permeability;
            EXPECT_LE(water(Sums::newton), 20.0) << c.name << ", " << permeability;
            double greatest = 0.0;
            for (const double ratio : state.discs.get<double>("overpressure_ratio"))
                greatest = std::max(greatest, ratio);
            EXPECT_LE(greatest, p.fracture_ratio * (1.0 + 1e-12)) << c.name << ", " << permeability;
        }
}

} // namespace
} // namespace listric::pore_fluid_hard_test
