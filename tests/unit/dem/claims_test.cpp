#include "dem/threads/shared_loop.hpp"
#include "dem/threads/team.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

namespace listric::dem::claims_test {
namespace {

TEST(Claims, EveryItemIsTakenOnceInEveryPhase) {
    constexpr std::uint32_t phases = 200;
    for (const std::size_t items : {0u, 1u, 2u, 7u, 64u})
        for (const int threads : {1, 2, 3}) {
            Claims claims(items, threads);
            Barrier barrier(threads);
            const Team team(threads);
            std::vector<std::atomic<std::uint32_t>> taken(items);
            run_team(threads, [&](int thread) {
                for (std::uint32_t phase = 1; phase <= phases; ++phase) {
                    claims.take(thread, phase, [&](std::size_t item) { ++taken[item]; });
                    barrier.wait();
                }
            });
            EXPECT_TRUE(std::ranges::all_of(taken, [](const auto& n) { return n == phases; }))
                << items << " items, " << threads << " threads";
        }
}

TEST(Claims, AThreadGoesOnWithWhatOthersHaveNotBegun) {
    Claims claims(7, 3);
    std::vector<std::size_t> taken;
    claims.take(1, 1, [&](std::size_t item) { taken.push_back(item); });
    EXPECT_EQ(taken, (std::vector<std::size_t>{2, 3, 4, 5, 6, 0, 1})); // its own first
    claims.take(0, 1, [&](std::size_t) { ADD_FAILURE() << "taken twice"; });
}

} // namespace
} // namespace listric::dem::claims_test
