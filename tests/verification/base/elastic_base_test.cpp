// Discs on an elastic base, whose compliance is made up: no finite elements are needed to see that
// the transfer keeps force, moment and work, that the rigid base is the limit, that it is stable
// with any masses and that neither threads nor the kind of cycle change a bit.

#include "dem/contacts/monitor.hpp"
#include "dem/numbers/order_free.hpp"
#include "tests/coupled_discs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace listric::elastic_base_test {

using namespace dem;
using namespace coupling;
namespace {

using namespace support;

TEST(ElasticBase, TransferKeepsForceMomentAndWork) {
    Coupled coupled = settled(soft);
    coupled.base.motion = {1.0, 1.0};
    coupled.go(2000);
    ASSERT_GT(coupled.greatest_displacement(), 0.01);
    // And with a wall that is bent by metres.
    for (const double bend : {0.0, 5.0}) {
        const BaseNodeColumns nodes = base_node_columns(coupled.state);
        Random random(3);
        for (std::size_t k = 0; k < nodes.x.size(); ++k) {
            nodes.ux[k] += random.between(-bend, bend);
            nodes.uy[k] += random.between(-bend, bend);
        }
        std::ranges::fill(coupled.state.base_contacts.get<double>("place"), -1.0);
        const InterfaceBalance balance = interface_balance(coupled.state, coupled.base);
        EXPECT_LT(balance.force_error, 1e-12);
        EXPECT_LT(balance.moment_error, 1e-12);
        EXPECT_LT(balance.work_error, 1e-12);
        EXPECT_GT(force_balance(coupled.state, coupled.base, standard_gravity).reaction[0].y, 0.0);
    }
}

TEST(ElasticBase, NodesCollectTheReactionOfTheCycle) {
    Coupled coupled(soft);
    coupled.state.clock.cycle = 1; // no look, which might list anew
    State before = coupled.state;
    coupled.go(0);
    advance(coupled.state, coupled.base, coupled.physics, 1, {1, Cycle::plain}, nullptr);
    double y = 0.0;
    for (const std::int64_t load : base_node_columns(coupled.state).load_y)
        y += load_unit * static_cast<double>(load);
    // The forces of a cycle are those at its start; shear forces are those after it.
    for (std::size_t k = 0; k < before.base_contacts.rows(); ++k)
        base_contact_columns(before).shear_force[k] =
            base_contact_columns(coupled.state).shear_force[k];
    const double reaction = force_balance(before, coupled.base, standard_gravity).reaction[0].y;
    EXPECT_NEAR(-y / reaction, 1.0, 1e-9);
}

TEST(ElasticBase, HeldNodesAreTheRigidBase) {
    Coupled coupled(soft);
    const double on_nodes =
        force_balance(coupled.state, coupled.base, standard_gravity).reaction[0].y;
    const double on_chain =
        force_balance(hanging_wall(), make_listric_base(), standard_gravity).reaction[0].y;
    // The trace departs from the arc by h^4 / (100 R^3), 3e-4 m against overlaps of 0.05 m.
    EXPECT_NEAR(on_nodes / on_chain, 1.0, 0.01);
}

TEST(ElasticBase, RigidIsTheLimit) {
    std::vector<double> u;
    for (const double factor : {1e-2, 1e-4, 1e-6}) {
        Coupled coupled = settled(factor * soft);
        coupled.base.motion = {1.0, 1.0};
        coupled.go(1500);
        u.push_back(coupled.greatest_displacement());
    }
    EXPECT_GT(u[0], 0.0);
    // First order. The discs' paths part with the first bond that breaks a cycle earlier.
    EXPECT_NEAR(std::log10(u[0] / u[1]), 2.0, 0.2);
    EXPECT_NEAR(std::log10(u[1] / u[2]), 2.0, 0.2);
}

TEST(ElasticBase, RestsWithoutExtension) {
    Coupled coupled = settled(soft);
    coupled.go(20000);
    // Settling leaves 2e-5 of the load, which bends 1,000 times less than the load would.
    EXPECT_LT(coupled.greatest_displacement(), 1e-3);
    EXPECT_GT(coupled.greatest_displacement(), 0.0);
}

TEST(ElasticBase, RefusesALoadThatDrifts) {
    Coupled coupled(soft);
    // Discs that grow heavier by a hundredth from window to window; 2e-5 are allowed.
    const auto heavier = [&](std::string_view, double) {
        for (double& mass : coupled.state.discs.get<double>("mass"))
            mass *= 1.01;
    };
    EXPECT_THROW(coupled.elastic.settle(coupled.state, coupled.base, coupled.physics, {1}, heavier),
                 NumericalFailure);
}

TEST(ElasticBase, HasTheSameBitsWithAnyThreadsAndInParts) {
    Coupled plain = settled(soft);
    plain.base.motion = {1.0, 1.0};
    plain.go(2500, {1, Cycle::plain});
    for (const int threads : {1, 2, 3}) {
        Coupled fast = settled(soft);
        fast.base.motion = {1.0, 1.0};
        for (const int part : {1, 3, 496, 2000}) // not multiples of the interval
            fast.go(part, {threads, fast_cycle()});
        EXPECT_EQ(hash(fast.state), hash(plain.state)) << threads;
    }
    EXPECT_GT(plain.greatest_displacement(), 0.01);
}

TEST(ElasticBase, AbsoluteDampingHasTheSameBitsToo) {
    Coupled plain(soft), fast(soft);
    for (Coupled* c : {&plain, &fast})
        c->base.motion = {1.0, 1.0};
    plain.go(500, {1, Cycle::plain});
    fast.go(500, {2, fast_cycle()});
    EXPECT_EQ(hash(fast.state), hash(plain.state));
    EXPECT_FALSE(plain.state.discs.has("mean_vx"));
}

TEST(ElasticBase, IsStableWithAnyMasses) {
    // A load that is not balanced: a tenth of the reference is taken off. Whatever mass, interval
    // and number of modes, it comes to rest where C (f - f0) says.
    for (const double compliance : {soft, 100.0 * soft})
        for (const auto& [interval, factor] :
             {std::pair(1, 0.6), std::pair(5, 0.6), std::pair(20, 0.6), std::pair(5, 60.0)}) {
            CouplingParameters p;
            p.interval = interval;
            p.mass_factor = factor;
            Coupled coupled = settled(compliance, p);
            for (double& load : coupled.state.base_nodes.get<double>("reference_load_y"))
                load *= 0.9;
            coupled.go(20000);
            const double u = coupled.greatest_displacement();
            const double before = u;
            coupled.go(2000);
            EXPECT_TRUE(std::isfinite(u));
            EXPECT_GT(u, 0.0);
            // Bounded by a few times the static answer to a tenth of the weight.
            EXPECT_LT(u, 2.0e11 * compliance) << interval << " " << factor;
            EXPECT_NEAR(coupled.greatest_displacement(), before, 0.05 * before)
                << compliance << " " << interval << " " << factor;
        }
}

TEST(ElasticBase, PressureIsKept) {
    const Interface interface = make_interface(soft);
    for (const auto& [from, to] : {std::pair(4000.0, 4123.0), std::pair(4000.0, 4600.0),
                                   std::pair(3990.0, 4000.0), std::pair(4000.0, 4000.0)}) {
        double force = 0.0, moment = 0.0;
        const std::vector<double> forces = pressure_forces(interface, from, to);
        for (std::size_t k = 0; k < forces.size(); ++k) {
            force += forces[k];
            moment += forces[k] * interface.x[k];
        }
        EXPECT_NEAR(force, to - from, 1e-9);
        EXPECT_NEAR(moment, 0.5 * (to * to - from * from), 1e-5);
    }
}

TEST(ElasticBase, ModesGiveTheComplianceBack) {
    const Interface interface = make_interface(soft);
    const std::size_t n = interface.unknowns();
    const Modes modes = find_modes(interface.compliance, n);
    double worst = 0.0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k) {
            double sum = 0.0;
            for (std::size_t m = 0; m < n; ++m)
                sum += modes.by_unknown[i * n + m] * modes.compliance[m] * modes.by_mode[m * n + k];
            worst = std::max(worst, std::abs(sum - interface.compliance[i * n + k]));
        }
    EXPECT_LT(worst, 1e-13 * soft * static_cast<double>(n));
    EXPECT_TRUE(std::ranges::is_sorted(modes.compliance, std::greater()));
    std::vector<double> wrong = interface.compliance;
    wrong[1] += soft;
    EXPECT_THROW(find_modes(wrong, n), std::invalid_argument);
    std::ranges::fill(wrong, 0.0);
    EXPECT_THROW(find_modes(wrong, n), std::invalid_argument);
}

} // namespace
} // namespace listric::elastic_base_test
