// When events are applied, and what a simulation tells of itself. Its physics is tested elsewhere.

#include "dem/simulation.hpp"
#include "tests/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace listric::simulation_test {

namespace {

using namespace dem;
using testing::ElementsAre;

/// Writes down its letter and the extension whenever it is applied.
class Witness : public Event {
public:
    Witness(char letter, double spacing, std::string& letters, std::vector<double>& extensions,
            Stage stage = Stage::adjust)
        : Event(std::string(1, letter), {spacing, 1.0}, stage), letters_(letters),
          extensions_(extensions) {}

    bool apply(State& state, const RigidBase&) override {
        letters_ += name();
        extensions_.push_back(state.clock.extension.m);
        return false;
    }

private:
    std::string& letters_;
    std::vector<double>& extensions_;
};

/// Takes the top disc away, so that contacts must be searched again.
class Thief : public Event {
public:
    Thief() : Event("thief", {1.0, 1.0}) {}
    bool apply(State& state, const RigidBase&) override {
        std::vector<std::int32_t> order;
        for (std::int32_t k = 0; k + 1 < static_cast<std::int32_t>(state.discs.rows()); ++k)
            order.push_back(k);
        reorder_discs(state, order);
        return true;
    }
};

/// Moves a disc and breaks a bond, but lists stay.
class Kick : public Event {
public:
    Kick() : Event("kick", {2.0, 1.0}) {}
    bool apply(State& state, const RigidBase&) override {
        disc_columns(state).vx[5] += 10.0;
        contact_columns(state).bonded[static_cast<std::size_t>(applied)] = 0;
        return false;
    }
};

/// Only looks.
class Onlooker : public Observer {
public:
    Onlooker() : Observer("onlooker", {1.0, 1.0}) { memory.add<double>("x", "m", 0.0); }
    bool apply(State& state, const RigidBase&) override {
        memory.resize(memory.rows() + 1);
        memory.get<double>("x").back() = disc_columns(state).x[5];
        return false;
    }
};

constexpr double time_step = 1e-3;      ///< s
constexpr double cycle_extension = 0.3; ///< m: spacings are no multiples of it

RigidBase moving_box() {
    RigidBase base = support::box(400.0, 400.0);
    base.motion = {.speed = cycle_extension / time_step, .ramp = 0.0};
    return base;
}

State discs_at_rest() {
    std::vector<support::Disc> discs = support::hexagonal(4, 4, 10.0);
    for (support::Disc& disc : discs) {
        disc.x += 100.0; // from the walls
        disc.y += 100.0;
    }
    State state = support::make_state(discs);
    state.clock.time_step = time_step;
    return state;
}

struct Witnessed : testing::Test {
    std::string letters;
    std::vector<double> extensions;

    void add_witnesses(Simulation& simulation) {
        simulation.add<Witness>('a', 10.0, letters, extensions);
        simulation.add<Witness>('b', 5.0, letters, extensions);
    }
};

using SimulationEvents = Witnessed;

TEST_F(SimulationEvents, AreAppliedInTheNearestCycleInTheOrderOfAdding) {
    Simulation simulation(moving_box(), {});
    add_witnesses(simulation);
    simulation.begin(discs_at_rest());
    EXPECT_TRUE(simulation.extend_to(20.0));
    EXPECT_EQ(letters, "babbab");
    const std::vector<double> due{5.0, 10.0, 10.0, 15.0, 20.0, 20.0};
    ASSERT_EQ(extensions.size(), due.size());
    for (std::size_t k = 0; k < due.size(); ++k)
        EXPECT_NEAR(extensions[k], due[k], 0.5 * cycle_extension + 1e-9);
    EXPECT_DOUBLE_EQ(simulation.next_due().m, 25.0);
}

TEST_F(SimulationEvents, AreAppliedByStage) {
    Simulation simulation(moving_box(), {});
    for (const auto& [letter, stage] : {std::pair('d', Stage::load),
                                        {'b', Stage::heal},
                                        {'a', Stage::sample},
                                        {'c', Stage::heal}})
        simulation.add<Witness>(letter, 5.0, letters, extensions, stage);
    simulation.begin(discs_at_rest());
    simulation.extend_to(5.0);
    EXPECT_EQ(letters, "abcd");
}

TEST_F(SimulationEvents, FindContactsAgainWhereTheyMust) {
    Simulation simulation(moving_box(), {});
    simulation.add<Thief>();
    std::map<std::string, int> parts;
    simulation.report_times_to([&](const std::string& part, double) { ++parts[part]; });
    simulation.begin(discs_at_rest());
    simulation.extend_to(2.0);
    EXPECT_EQ(simulation.discs().x.size(), 14u);
    EXPECT_EQ(parts["thief"], 2);
    EXPECT_EQ(parts["rebuild"], 2);
    EXPECT_EQ(simulation.find<Thief>()->applied, 2);
    EXPECT_EQ(simulation.find<Witness>(), nullptr);
}

TEST_F(SimulationEvents, ChangeWhatCyclesGoOnFrom) {
    const auto hash_of = [](const Execution& execution) {
        Simulation simulation(moving_box(), {.gravity = 9.81});
        simulation.add<Onlooker>();
        simulation.add<Kick>();
        State state = discs_at_rest();
        support::bond_all(state, moving_box());
        simulation.begin(std::move(state));
        simulation.extend_to(10.0, execution);
        simulation.state().discs.get<double>("vy")[3] -= 5.0; // by what is no event
        simulation.extend_to(20.0, execution);
        EXPECT_EQ(simulation.find<Kick>()->applied, 10);
        return simulation.hash();
    };
    const std::uint64_t plain = hash_of({1, Cycle::plain});
    for (int threads : {1, 2, 3})
        EXPECT_EQ(hash_of({threads, fast_cycle()}), plain) << threads << " threads";
}

TEST_F(SimulationEvents, AStoppedAndResumedSimulationIsTheSame) {
    Simulation whole(moving_box(), {.gravity = 9.81});
    add_witnesses(whole);
    whole.begin(discs_at_rest());
    whole.extend_to(20.0);
    const std::string in_one_go = std::exchange(letters, "");

    Simulation first(moving_box(), {.gravity = 9.81});
    add_witnesses(first);
    first.begin(discs_at_rest());
    // Events due at the moment of the stop have been applied.
    EXPECT_FALSE(
        first.extend_to(20.0, {}, [](const Simulation& s) { return s.extension().m < 9.0; }));
    EXPECT_EQ(letters, "bab");

    Simulation second(moving_box(), {.gravity = 9.81});
    add_witnesses(second);
    for (std::size_t k = 0; k < first.events().size(); ++k)
        second.events()[k]->applied = first.events()[k]->applied;
    second.resume(first.state());
    EXPECT_TRUE(second.extend_to(20.0));
    EXPECT_EQ(letters, in_one_go);
    EXPECT_EQ(second.hash(), whole.hash());
}

} // namespace

} // namespace listric::simulation_test
