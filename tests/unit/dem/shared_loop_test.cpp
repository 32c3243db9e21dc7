// Loops that threads share give what one loop gives, whatever the threads. Exact comparisons.

#include "dem/threads/shared_loop.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <iterator>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

namespace listric::shared_loop_test {

using namespace dem;
namespace {

TEST(SharedLoop, PiecesCoverAllInTheirOrder) {
    for (int threads : {1, 2, 3, 5})
        for (std::size_t items : {0, 1, 63, 64, 65, 5000}) {
            const Team team(threads);
            std::vector<std::size_t> expected(items);
            std::iota(expected.begin(), expected.end(), std::size_t{0});
            const auto all = joined(by_piece(items, 64, [](std::size_t begin, std::size_t end) {
                EXPECT_EQ(begin % 64, 0u);
                std::vector<std::size_t> piece(end - begin);
                std::iota(piece.begin(), piece.end(), begin);
                return piece;
            }));
            EXPECT_EQ(all, expected) << items << " by " << threads;
            std::vector<int> visits(items);
            in_pieces(items, 64, [&](std::size_t begin, std::size_t end) {
                for (; begin < end; ++begin)
                    ++visits[begin];
            });
            EXPECT_EQ(visits, std::vector<int>(items, 1));
        }
}

TEST(SharedLoop, ATeamSharesUntilItIsGoneAndNotWithinItsLoops) {
    const auto threads_at_work = [] {
        const auto ids = by_piece(8, 1, [](std::size_t, std::size_t) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            EXPECT_EQ(team_size(), 1);
            return std::this_thread::get_id();
        });
        return std::set<std::thread::id>(ids.begin(), ids.end()).size();
    };
    EXPECT_EQ(threads_at_work(), 1u);
    {
        const Team team(3);
        EXPECT_GT(threads_at_work(), 1u);
        EXPECT_EQ(team_size(), 3);
    }
    EXPECT_EQ(threads_at_work(), 1u);
}

TEST(SharedLoop, AThreadIsStartedWhenThereIsAPieceForIt) {
    const auto threads = [] {
        const std::filesystem::path tasks = "/proc/self/task"; // where the system has it
        std::error_code none;
        std::filesystem::directory_iterator each(tasks, none);
        return std::distance(each, std::filesystem::directory_iterator());
    };
    const Team team(500);
    const auto before = threads();
    for_each_shared(3, [](std::size_t) {});
    EXPECT_LE(threads(), before + 2);
    EXPECT_EQ(threads_at_hand(2), 2);
    EXPECT_EQ(threads_at_hand(5), 5);
    EXPECT_LE(threads(), before + 4);
}

TEST(SharedLoop, ATeamHasAThread) {
    EXPECT_THROW(Team(0), std::invalid_argument);
    EXPECT_THROW(Team(-1), std::invalid_argument);
    EXPECT_EQ(team_size(), 1);
}

TEST(SharedLoop, Sorts) {
    for (std::size_t items : {0, 1, 1999, 2001, 9000, 30000}) {
        std::vector<std::size_t> shuffled(items);
        for (std::size_t k = 0; k < items; ++k)
            shuffled[k] = 7919 * k % 30011; // a prime: no two are equal
        std::vector<std::size_t> expected = shuffled;
        std::ranges::sort(expected, std::greater{});
        for (int threads : {1, 2, 3, 5}) {
            const Team team(threads);
            std::vector<std::size_t> sorted = shuffled;
            sort_shared(std::span(sorted), std::greater{});
            EXPECT_EQ(sorted, expected) << items << " by " << threads;
        }
    }
}

TEST(SharedLoop, TheFirstFailureInOrderIsThrownAndNothingElseBegun) {
    for (int threads : {1, 3}) {
        const Team team(threads);
        std::vector<int> done(2000);
        try {
            for_each_shared(done.size(), [&](std::size_t k) {
                done[k] = 1;
                std::this_thread::sleep_for(std::chrono::milliseconds(k == 3 ? 20 : 5));
                if (k == 7 || k == 3)
                    throw std::runtime_error(std::to_string(k));
            });
            FAIL();
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "3");
        }
        EXPECT_TRUE(done[0] && done[1] && done[2] && done[3]);
        EXPECT_FALSE(done.back());
    }
}

} // namespace
} // namespace listric::shared_loop_test
