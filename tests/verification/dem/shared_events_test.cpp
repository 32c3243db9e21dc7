// Threads that share the loops of events change no bit: a slab that is cut by a fault is looked at
// by every event that shares its loops. Exact comparisons.

#include "dem/events/bond_healing.hpp"
#include "dem/events/equilibrium.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/property_update.hpp"
#include "dem/events/strain.hpp"
#include "dem/threads/shared_loop.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace listric::shared_events_test {

using namespace dem;
namespace {

using namespace support;

constexpr double rate = 0.01, gravity = 9.81;
constexpr std::size_t columns = 70, rows = 60; ///< of discs: loops are cut at thousands of them

/// A slab and what events made of it.
struct Slab {
    State state;
    std::vector<std::unique_ptr<Event>> events;
    std::ptrdiff_t bonds_before = 0, bonds_healed = 0;

    explicit Slab(int threads) {
        const Team team(threads);
        const RigidBase base = box(3.0 * columns * 93.1, 1e6, 0.3);
        std::vector<Disc> discs = cloud(columns, rows, 93.1, 5);
        for (Disc& disc : discs)
            disc.y += 93.1;
        state = make_state(discs);
        bond_all(state, base);
        const ContactColumns c = contact_columns(state);
        for (std::size_t k = 0; k < c.first.size(); k += 3)
            c.bonded[k] = 0;
        events.push_back(std::make_unique<Equilibrium>(rate, gravity));
        const BondHealingParameters healing{.strain_rate = 2e-13}; // 3 m of slip
        events.push_back(std::make_unique<BondHealing>(healing, BondStrength{}, rate));
        const FaultWeakeningParameters faults{.spacing_diameters = 2.0};
        events.push_back(std::make_unique<FaultWeakening>(faults, rate, gravity));
        events.push_back(std::make_unique<PropertyUpdate>(faults, rate, gravity));
        events.push_back(std::make_unique<Strain>(500.0, rate));
        for (const auto& event : events)
            event->begin(state);
        move();
        bonds_before = bonds();
        for (const auto& event : events) {
            if (event->apply(state, base))
                find_contacts(state, base);
            if (event->name() == "bond_healing")
                bonds_healed = bonds();
        }
    }

    /// All discs slip a little past each other, those right of an inclined plane a lot.
    void move() {
        Random random(6);
        const DiscColumns d = disc_columns(state);
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const bool right = d.x[i] > 6000.0 + 0.5 * d.y[i];
            d.x[i] += random.between(-4.0, 4.0) + (right ? 60.0 : 0.0);
            d.y[i] += random.between(-4.0, 4.0) - (right ? 120.0 : 0.0);
        }
        state.clock.travel.m = state.clock.extension.m = 2000.0;
    }

    std::ptrdiff_t bonds() const {
        return std::ranges::count(contact_columns(state).bonded, std::uint8_t{1});
    }
};

TEST(SharedEvents, HaveTheBitsOfOneThread) {
    const Slab alone(1);
    // All events have had something to do, and more of it than one piece of a loop.
    EXPECT_GT(std::ranges::count(disc_columns(alone.state).material, weak), 150);
    EXPECT_GT(alone.state.discs.get<double>("total_strain")[100], 0.0);
    EXPECT_GT(alone.bonds_healed, alone.bonds_before + 300);
    EXPECT_LT(alone.bonds(), alone.bonds_healed);
    EXPECT_GT(alone.events[0]->memory.get<double>("mean_ratio_sum")[0], 0.0);
    for (int threads : {2, 3, 5}) {
        const Slab shared(threads);
        EXPECT_EQ(hash(shared.state, shared.events), hash(alone.state, alone.events))
            << threads << " threads";
    }
}

} // namespace
} // namespace listric::shared_events_test
