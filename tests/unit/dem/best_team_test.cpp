// A team has as many threads as do most. Machines are formulas here; speeds and windows are theirs.

#include "dem/threads/best_team.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>

namespace listric::best_team_test {

using namespace dem;
namespace {

/// Work of a team of a size in a second, and the share of its time in which it waits.
struct Pace {
    double speed, asleep;
};

using Machine = std::function<Pace(int size)>;

Pace quiet(int size) { return {size == 1 ? 1.0 : 0.95 * size, 0.01}; }

/// Another program takes half of a core, and all wait for the thread on it.
Pace shared_core(int size) { return size == 1 ? Pace{1.0, 0.0} : Pace{0.75, 0.25}; }

/// Work that is done in so many seconds, in pieces of 20 ms.
double work_in(double seconds, BestTeam& team, const Machine& machine) {
    constexpr double piece = 0.02;
    double work = 0.0;
    for (std::int64_t k = std::llround(seconds / piece); k > 0; --k) {
        const auto [speed, asleep] = machine(team.size());
        team.report(piece * speed, piece, asleep * piece * team.size());
        work += piece * speed;
    }
    return work;
}

TEST(BestTeam, HasAllThreadsOnAQuietMachine) {
    for (int most : {1, 2, 16}) {
        BestTeam team(most);
        EXPECT_EQ(team.size(), most);
        EXPECT_NEAR(work_in(10.0, team, quiet), 10.0 * quiet(most).speed, 1e-9);
        EXPECT_EQ(team.size(), most);
    }
}

TEST(BestTeam, LosesLittleToAnotherProgram) {
    BestTeam team(2);
    EXPECT_GT(work_in(10.0, team, shared_core), 0.98 * 10.0); // one thread does 10
}

TEST(BestTeam, GrowsAgainWhenTheOtherProgramHasEnded) {
    BestTeam team(2);
    work_in(10.0, team, shared_core);
    work_in(5.0, team, quiet);
    EXPECT_NEAR(work_in(5.0, team, quiet), 5.0 * quiet(2).speed, 1e-9);
}

TEST(BestTeam, WaitingThatDoesMoreIsKept) {
    // Threads wait a third of their time, as in a cycle too short for so many, and are faster yet.
    const Machine waits = [](int size) { return Pace{size == 1 ? 1.0 : 1.33, 0.33}; };
    BestTeam team(2);
    EXPECT_GT(work_in(10.0, team, waits), 0.97 * 13.3);
}

TEST(BestTeam, ShrinksByStepsToWhatFits) {
    // Sixteen threads on eight cores that are free.
    const Machine eight = [](int size) {
        return size <= 8 ? Pace{1.0 * size, 0.01} : Pace{64.0 / size, 0.3};
    };
    BestTeam team(16);
    work_in(10.0, team, eight);
    EXPECT_GT(work_in(10.0, team, eight), 0.9 * 80.0);
}

TEST(BestTeam, IsSoonOneThreadWhereAllCoresAreBusy) {
    // As measured on two busy cores, where every meeting of threads costs a slice of time.
    const Machine busy = [](int size) {
        return size == 1 ? Pace{1e8, 0.0} : Pace{1e7 / size, 0.9};
    };
    for (int most : {2, 8, 64}) {
        BestTeam team(most);
        double work = 0.0, seconds = 0.0;
        while (work < 2e8) { // of two seconds by one thread
            const auto [speed, asleep] = busy(team.size());
            const double piece = team.piece(), took = piece / speed;
            team.report(piece, took, asleep * took * team.size());
            work += piece;
            seconds += took;
        }
        EXPECT_LT(seconds, most < 10 ? 2.4 : 3.6) << most;
    }
}

} // namespace
} // namespace listric::best_team_test
