// A state in shares, each of which makes its cycles alone and is told its ghosts after each, ends
// in the bits of the whole: here all in one process.

#include "apps/run/genesis_cache.hpp"
#include "apps/scene/scene_file.hpp"
#include "dem/base_place.hpp"
#include "dem/contacts.hpp"
#include "dem/order_free.hpp"
#include "dem/random.hpp"
#include "dem/share.hpp"
#include "dem/simulation.hpp"
#include "tests/scene_runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

namespace listric {

namespace {

using namespace dem;

enum class Ownership { rows, scattered };

/// Makes cycles in shares, as ranks would. The base is rigid.
class EmulatedRanks {
public:
    EmulatedRanks(int count, Ownership ownership, Execution how)
        : count_(count), ownership_(ownership), how_(std::move(how)) {}

    void advance(State& whole, const RigidBase& base, const CyclePhysics& physics,
                 std::int64_t cycles) {
        cut_anew(whole);
        for (; cycles > 0; --cycles) {
            if (whole.clock.cycle % whole.look_interval == 0)
                look(whole, base);
            cycle(whole, base, physics);
        }
        gather(whole);
    }

    int updates = 0;        ///< of the neighbour lists
    std::size_t ghosts = 0; ///< at the last cut
    std::size_t empty = 0;  ///< ranks without discs then

private:
    void cut_anew(const State& whole) {
        std::vector<std::int32_t> rank = ranks_by_rows(whole, count_);
        if (ownership_ == Ownership::scattered)
            for (std::size_t i = 0; i < rank.size(); ++i)
                rank[i] = static_cast<std::int32_t>((i * 7919 + i / 3) %
                                                    static_cast<std::size_t>(count_));
        shares_ = cut(whole, rank, count_);
        ghosts = empty = 0;
        for (const Share& share : shares_) {
            const auto own = static_cast<std::size_t>(std::ranges::count(share.own, 1));
            ghosts += share.rows.size() - own;
            empty += own == 0;
        }
    }

    void gather(State& whole) const {
        for (const Share& share : shares_)
            put_back(share, whole);
    }

    double greatest_of_own(const auto& value) const {
        double greatest = 0.0;
        for (const Share& share : shares_) {
            const ConstDiscColumns d = disc_columns(share.state);
            for (std::size_t i = 0; i < share.own.size(); ++i)
                if (share.own[i])
                    greatest = greater(greatest, value(d, i));
        }
        return greatest;
    }

    /// As look_for_neighbours() of the plain cycle.
    void look(State& whole, const RigidBase& base) {
        if (is_check_due(whole.displacement_bound, whole.skin)) {
            const double square = greatest_of_own([](const ConstDiscColumns& d, std::size_t i) {
                const double dx = d.x[i] - d.searched_x[i], dy = d.y[i] - d.searched_y[i];
                return dx * dx + dy * dy;
            });
            whole.displacement_bound =
                greater(std::sqrt(square), surface_travel(whole, base, whole.clock.extension));
            if (is_update_due(whole.displacement_bound, whole.skin)) {
                gather(whole);
                update_contacts(whole, base);
                cut_anew(whole);
                ++updates;
            }
        }
        whole.look_interval = next_look_interval(whole.look_interval, whole.window_speed,
                                                 whole.clock.time_step, whole.skin);
        whole.window_speed = 0.0;
    }

    void cycle(State& whole, const RigidBase& base, const CyclePhysics& physics) {
        for (Share& share : shares_) {
            share.state.displacement_bound = 0.0; // to look is the whole's affair
            share.state.look_interval = std::int64_t{1} << 60;
            dem::advance(share.state, base, physics, 1, how_);
        }
        for (std::size_t r = 0; r < shares_.size(); ++r)
            for (std::size_t s = 0; s < shares_.size(); ++s) {
                std::vector<double> numbers(ghost_numbers * shares_[r].sent[s].size());
                read_ghosts(shares_[r].state, shares_[r].sent[s], numbers);
                write_ghosts(numbers, shares_[s].received[r], shares_[s].state);
            }
        const double speed = base.motion.speed_at(whole.clock.time());
        const double fastest =
            greater(greatest_of_own([](const ConstDiscColumns& d, std::size_t i) {
                        return greater(std::abs(d.vx[i]), std::abs(d.vy[i]));
                    }),
                    greatest_translation(base) * speed);
        whole.window_speed = greater(whole.window_speed, fastest);
        whole.displacement_bound += std::numbers::sqrt2 * fastest * whole.clock.time_step;
        whole.clock.extension += speed * whole.clock.time_step;
        ++whole.clock.cycle;
    }

    int count_;
    Ownership ownership_;
    Execution how_;
    std::vector<Share> shares_;
};

class Shares : public support::SceneRuns {
protected:
    const Scene scene = load_scene({.scene = support::test_scene("every-effect.toml")});
    const ModelParts parts = make_parts(scene);

    /// The simulation of the scene, with its events, at an extension of 100 m.
    std::uint64_t hash_at_end(const Simulation::Advance& advance) {
        Simulation sandbox(parts.base, parts.physics);
        for (auto& event : make_events(scene, parts))
            sandbox.add(std::move(event));
        if (advance)
            sandbox.advance_by(advance);
        Log log(true);
        sandbox.begin(make_or_recall_hanging_wall(scene, parts, log, {}, 1));
        sandbox.extend_to(100.0);
        cycles = sandbox.state().clock.cycle;
        return sandbox.hash();
    }

    std::int64_t cycles = 0;
};

TEST_F(Shares, ComeToTheBitsOfTheWhole) {
    const std::uint64_t whole = hash_at_end({});
    EXPECT_GT(cycles, 2000);
    for (const int count : {1, 2, 3, 5, 8})
        for (const Ownership ownership : {Ownership::rows, Ownership::scattered})
            for (const Cycle cycle : {Cycle::plain, best_cycle()})
                for (const int threads : {1, 2}) {
                    SCOPED_TRACE(fmt::format("{} shares, {}, {} cycle, {} threads", count,
                                             ownership == Ownership::rows ? "rows" : "scattered",
                                             name(cycle), threads));
                    EmulatedRanks ranks(count, ownership, {.threads = threads, .cycle = cycle});
                    EXPECT_EQ(hash_at_end([&](State& state, const RigidBase& base,
                                              const CyclePhysics& physics, std::int64_t n,
                                              const Execution&) {
                                  ranks.advance(state, base, physics, n);
                              }),
                              whole);
                    EXPECT_GT(ranks.updates, 0);
                    EXPECT_EQ(ranks.ghosts > 0, count > 1);
                    if (cycle == Cycle::plain && threads == 2)
                        break;
                }
}

} // namespace

} // namespace listric
