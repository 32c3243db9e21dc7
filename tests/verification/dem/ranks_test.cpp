// Cycles on several ranks end in the bits of one: here ranks are threads of one process.

#include "apps/run/genesis_cache.hpp"
#include "apps/scene/scene_file.hpp"
#include "dem/base/motion.hpp"
#include "dem/ranks/ranked_cycles.hpp"
#include "dem/simulation.hpp"
#include "tests/emulated_ranks.hpp"
#include "tests/scene_runs.hpp"
#include "tests/support.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace listric::ranks_test {

namespace {

using namespace dem;

std::vector<std::int32_t> scattered(const State& whole, int count) {
    std::vector<std::int32_t> rank;
    for (std::size_t i = 0; i < whole.discs.rows(); ++i)
        rank.push_back(
            static_cast<std::int32_t>((i * 7919 + i / 3) % static_cast<std::size_t>(count)));
    return rank;
}

/// All but the last rank.
std::vector<std::int32_t> crowded(const State& whole, int count) {
    std::vector<std::int32_t> rank = ranks_by_rows(whole, std::max(count - 1, 1));
    return rank;
}

/// A base that gives way under its loads.
class Yielding : public BaseResponse {
public:
    Yielding() { interval = 7; } // so that events come between answers
    void respond(State& state, const Clock&) override {
        const BaseNodeColumns nodes = base_node_columns(state);
        for (std::size_t k = 0; k < nodes.x.size(); ++k) {
            nodes.vx[k] = 1e-13 * static_cast<double>(nodes.load_x[k]);
            nodes.vy[k] = 1e-13 * static_cast<double>(nodes.load_y[k]);
            nodes.load_x[k] = nodes.load_y[k] = 0;
        }
        ++answers;
    }

    int answers = 0;
};

class RanksTest : public support::SceneRuns {
protected:
    RanksTest() : RanksTest(std::vector<std::string>{}) {}
    explicit RanksTest(const std::vector<std::string>& set)
        : scene(load_scene({.scene = support::test_scene("every-effect.toml"), .set = set})),
          parts(make_parts(scene)) {}

    const Scene scene;
    const ModelParts parts;

    /// The simulation of the scene, with its events, at an extension of 100 m.
    /// @param nodes  of the base; none: it is rigid
    std::uint64_t hash_at_end(const Simulation::Advance& advance,
                              const Simulation::Collect& collect = {},
                              const std::vector<Point>& nodes = {}) {
        Simulation sandbox(parts.base, parts.physics);
        for (auto& event : make_events(scene, parts))
            sandbox.add(std::move(event));
        if (advance)
            sandbox.advance_by(advance, collect);
        Log log(true);
        State state = make_or_recall_hanging_wall(scene, parts, log, {}, {}, 1);
        if (!nodes.empty()) {
            std::vector<double> x, y;
            for (const Point& node : nodes) {
                x.push_back(node.x);
                y.push_back(node.y);
            }
            add_base_nodes(state, x, y);
        }
        sandbox.begin(std::move(state));
        sandbox.extend_to(100.0);
        cycles = sandbox.state().clock.cycle;
        return sandbox.hash();
    }

    std::uint64_t hash_on_ranks(int count, RankedCycles::Ownership ownership, const Execution& how,
                                const std::vector<Point>& nodes = {},
                                BaseResponse* response = nullptr) {
        std::uint64_t hash = 0;
        support::EmulatedRanks ranks(count);
        ranks.run(
            [&](Ranks& root) {
                RankedCycles on_ranks(root, parts.base, parts.physics, how, ownership);
                hash = hash_at_end(
                    [&](State& state, const RigidBase&, const CyclePhysics&, std::int64_t n,
                        const Execution& asked) {
                        on_ranks.advance(state, n, asked.state_is_untouched, response);
                    },
                    [&](State& state) { on_ranks.collect(state); }, nodes);
            },
            [&](Ranks& other) { RankedCycles(other, parts.base, parts.physics, how).serve(); });
        EXPECT_EQ(ranks.exchanged > 0, count > 1);
        EXPECT_GT(ranks.exchanges, 10u); // two for every update of lists
        return hash;
    }

    std::int64_t cycles = 0;
};

/// With mud whose pore pressure pushes on the discs.
class MudOnRanks : public RanksTest {
protected:
    MudOnRanks()
        : RanksTest({"sedimentation.target=[[0.0,0.0]]", "sedimentation.interval_a=2500",
                     "pore_fluid.permeability_m2=1e-19"}) {}
};

/// With discs that resist rolling.
class SandOnRanks : public RanksTest {
protected:
    SandOnRanks() : RanksTest({"material.friction=0.6", "material.rolling_friction=0.3"}) {}
};

TEST_F(SandOnRanks, EndsInTheBitsOfOneProcess) {
    const std::uint64_t whole = hash_at_end({});
    for (const int count : {2, 3})
        EXPECT_EQ(hash_on_ranks(count, scattered, {}), whole) << count;
}

TEST_F(MudOnRanks, EndsInTheBitsOfOneProcess) {
    const std::uint64_t whole = hash_at_end({});
    for (const int count : {2, 3})
        EXPECT_EQ(hash_on_ranks(count, ranks_by_rows, {}), whole) << count;
}

TEST_F(RanksTest, EndInTheBitsOfOneProcess) {
    const std::uint64_t whole = hash_at_end({});
    EXPECT_GT(cycles, 2000);
    for (const int count : {1, 2, 3, 5, 8})
        for (const auto& [kind, ownership] :
             {std::pair("rows", &ranks_by_rows), std::pair("scattered", &scattered)})
            for (const Cycle cycle : {Cycle::plain, best_cycle()})
                for (const int threads : {1, 2}) {
                    SCOPED_TRACE(fmt::format("{} ranks, {}, {} cycle, {} threads", count, kind,
                                             name(cycle), threads));
                    EXPECT_EQ(hash_on_ranks(count, ownership, {.threads = threads, .cycle = cycle}),
                              whole);
                    if (cycle == Cycle::plain)
                        break; // it has one thread
                }
}

TEST_F(RanksTest, ARankMayBeWithoutDiscs) {
    EXPECT_EQ(hash_on_ranks(3, crowded, {.threads = 1}), hash_at_end({}));
}

TEST_F(RanksTest, ABaseAnswersToTheLoadsOfAllRanks) {
    const std::vector<Point> nodes = detachment_nodes(parts.base.surfaces.front().chain, 300.0);
    Yielding whole_base;
    const std::uint64_t whole = hash_at_end(
        [&](State& state, const RigidBase& base, const CyclePhysics& physics, std::int64_t n,
            const Execution& how) { dem::advance(state, base, physics, n, how, &whole_base); },
        {}, nodes);
    EXPECT_GT(whole_base.answers, 100);
    EXPECT_NE(whole, hash_at_end({}));
    for (const int count : {1, 2, 3})
        for (const Cycle cycle : {Cycle::plain, best_cycle()}) {
            SCOPED_TRACE(fmt::format("{} ranks, {} cycle", count, name(cycle)));
            Yielding base;
            EXPECT_EQ(
                hash_on_ranks(count, ranks_by_rows, {.threads = 1, .cycle = cycle}, nodes, &base),
                whole);
            EXPECT_EQ(base.answers, whole_base.answers);
        }
}

/// Hash of discs that fall in a box on ranks; without ranks (0) in one process.
std::uint64_t hash_of_fallen(const State& start, int count, const Execution& how) {
    const RigidBase base = support::box(200.0, 100.0, 0.3);
    const CyclePhysics physics{.damping = 0.1, .gravity = 9.81};
    State state = start;
    find_contacts(state, base);
    constexpr std::int64_t cycles = 2000;
    if (count == 0) {
        advance(state, base, physics, cycles, how);
        return hash(state);
    }
    support::EmulatedRanks ranks(count);
    ranks.run(
        [&](Ranks& root) {
            RankedCycles on_ranks(root, base, physics, how);
            on_ranks.advance(state, cycles, false);
            on_ranks.collect(state);
        },
        [&](Ranks& other) { RankedCycles(other, base, physics, how).serve(); });
    return hash(state);
}

TEST(Ranks, MayHaveOneDiscOrFewerThanATileEach) {
    for (const auto& discs :
         {std::vector<support::Disc>{{50.0, 20.0, 4.0}}, support::cloud(4, 3, 10.0, 1)}) {
        State state = support::make_state(discs, {1e9, 1e9, 0.5, false});
        for (double& y : disc_columns(state).y)
            y += 20.0;
        state.clock.time_step = 1e-3;
        for (const Cycle cycle : {Cycle::plain, best_cycle()}) {
            const std::uint64_t whole = hash_of_fallen(state, 0, {.cycle = cycle});
            EXPECT_NE(whole, hash(state));
            for (const int count : {2, 3, 8})
                EXPECT_EQ(hash_of_fallen(state, count, {.cycle = cycle}), whole)
                    << discs.size() << " discs on " << count << " ranks, " << name(cycle);
        }
    }
}

} // namespace

} // namespace listric::ranks_test
