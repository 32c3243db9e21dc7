#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace listric::dem {

// Loops that threads share. Whoever is free takes the next piece, and nobody waits for a thread
// that has not begun: one that does not get a core takes less. Pieces do not depend on each other,
// and their results are put together in order: one thread's loop gives equal bits.

/// While it lives, its threads share the loops of the calling thread; fewer of them where there is
/// no memory for more. A thread is started when a loop has a piece for it.
class Team {
public:
    /// Throws std::invalid_argument for less than one thread.
    explicit Team(int threads);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

private:
    class Helpers;
    friend int team_size();
    friend int threads_at_hand(std::size_t);
    friend void for_each_shared(std::size_t, const std::function<void(std::size_t)>&);
    friend void run_team(int, const std::function<void(int)>&);
    Helpers& helpers(std::size_t pieces);

    int threads_;
    Team* before_;
    std::unique_ptr<Helpers> helpers_; ///< once there was a loop for them
};

/// Threads that share a loop of the calling thread.
int team_size();

/// Number of threads that could be started for a loop of these pieces: at most one per piece.
int threads_at_hand(std::size_t pieces);

/// Calls work(k) for k = 0 .. count - 1. Loops within it are not shared again. After a failure no
/// further call begins; of what the calls have thrown, the first in order of k is thrown again,
/// whatever the threads.
void for_each_shared(std::size_t count, const std::function<void(std::size_t)>& work);

/// Calls work(k) for k = 0 .. threads - 1, each on a thread of its own, and waits for all: they may
/// wait for each other. The calling thread makes the first. As those that meet at a barrier would
/// wait for ever for one that failed, among several that ends the program (std::terminate).
/// @param threads  no more than are at hand
void run_team(int threads, const std::function<void(int)>& work);

/// How a loop is cut: some pieces a thread, so that one that is late holds up little.
struct Pieces {
    std::size_t count, size; ///< the last may be shorter

    /// A piece is a multiple of `least` long, which is to take long enough to be worth a thread,
    /// some 0.1 ms.
    Pieces(std::size_t items, std::size_t least) {
        const std::size_t most = team_size() > 1 ? 8 * static_cast<std::size_t>(team_size()) : 1;
        size = least * std::max<std::size_t>(1, (items + most * least - 1) / (most * least));
        count = std::max<std::size_t>(1, (items + size - 1) / size);
    }
};

/// Calls work(begin, end) for the pieces of 0 .. items; for at least one.
template <class Work> void in_pieces(std::size_t items, std::size_t least, Work&& work) {
    const Pieces pieces(items, least);
    for_each_shared(pieces.count, [&](std::size_t k) {
        work(k * pieces.size, std::min((k + 1) * pieces.size, items));
    });
}

/// Results of work(begin, end) for the pieces of 0 .. items, in their order; for at least one.
template <class Work> auto by_piece(std::size_t items, std::size_t least, Work&& work) {
    const Pieces pieces(items, least);
    std::vector<std::invoke_result_t<Work, std::size_t, std::size_t>> results(pieces.count);
    for_each_shared(pieces.count, [&](std::size_t k) {
        results[k] = work(k * pieces.size, std::min((k + 1) * pieces.size, items));
    });
    return results;
}

/// One list of those that pieces have, which are taken.
template <class AllPieces, class List = std::identity>
auto joined(AllPieces&& pieces, List list = {}) {
    auto all = std::move(std::invoke(list, pieces.front()));
    for (auto piece = pieces.begin() + 1; piece != pieces.end(); ++piece)
        all.insert(all.end(), std::invoke(list, *piece).begin(), std::invoke(list, *piece).end());
    return all;
}

/// Sorts by an order in which no two are equal.
template <class T, class Less> void sort_shared(std::span<T> values, Less less) {
    const auto threads = static_cast<std::size_t>(team_size());
    std::size_t sorted = std::max<std::size_t>(2000, (values.size() + threads - 1) / threads);
    const auto at = [&](std::size_t k) {
        return values.begin() + static_cast<std::ptrdiff_t>(std::min(k, values.size()));
    };
    in_pieces(values.size(), sorted,
              [&](std::size_t begin, std::size_t end) { std::sort(at(begin), at(end), less); });
    if (threads == 1)
        return;
    for (; sorted < values.size(); sorted *= 2)
        in_pieces((values.size() - 1) / (2 * sorted) + 1, 1, [&](std::size_t k, std::size_t end) {
            for (; k < end; ++k)
                std::inplace_merge(at(2 * k * sorted), at((2 * k + 1) * sorted),
                                   at((2 * k + 2) * sorted), less);
        });
}

} // namespace listric::dem
