#pragma once

#include "dem/threads/pause.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <vector>

namespace listric::dem {

/// Meeting point of a fixed number of threads. A cycle lasts about 0.1 ms and being woken takes as
/// long, so waiting spins for about that time; then it sleeps, or else two threads on a shared
/// machine would keep each other from the core that they wait for. Where spinning is in vain again
/// and again there are fewer cores than threads: then they sleep almost at once.
class Barrier {
public:
    explicit Barrier(int threads) : threads_(threads) {}

    void wait() {
        if (threads_ == 1)
            return;
        const unsigned round = round_.load(std::memory_order_relaxed);
        if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads_) {
            arrived_.store(0, std::memory_order_relaxed);
            round_.store(round + 1, std::memory_order_release);
            round_.notify_all();
            return;
        }
        const int patience = patience_.load(std::memory_order_relaxed);
        for (int spins = 0; spins < patience; ++spins) {
            if (round_.load(std::memory_order_acquire) != round) {
                if (patience < most_patience)
                    patience_.store(std::min(most_patience, 2 * patience),
                                    std::memory_order_relaxed);
                return;
            }
            pause();
        }
        patience_.store(std::max(least_patience, patience / 2), std::memory_order_relaxed);
        const auto before = std::chrono::steady_clock::now();
        round_.wait(round, std::memory_order_acquire);
        asleep_ += std::chrono::nanoseconds(std::chrono::steady_clock::now() - before).count();
    }

    /// How long threads have slept here, all together, s.
    double asleep() const { return 1e-9 * static_cast<double>(asleep_.load()); }

private:
    static constexpr int least_patience = 125, most_patience = 8000; ///< pauses

    const int threads_;
    std::atomic<int> patience_ = most_patience; ///< written only where a thread has slept
    alignas(64) std::atomic<int> arrived_ = 0;
    alignas(64) std::atomic<unsigned> round_ = 0;
    std::atomic<std::int64_t> asleep_ = 0; ///< ns
};

/// Work that the threads of a team take in phases which end at a barrier. Everyone begins with its
/// own share and goes on with what nobody has begun, so that a thread without a core takes less.
/// A share is a line of the cache, which comes from another core only when its thread is done.
class Claims {
public:
    Claims(std::size_t items, int threads) : shares_(static_cast<std::size_t>(threads)) {
        for (std::size_t k = 0; k < shares_.size(); ++k) {
            shares_[k].first = items * k / shares_.size();
            shares_[k].size = items * (k + 1) / shares_.size() - shares_[k].first;
        }
    }

    /// Calls work(item) for items that are free. Phases count from 1.
    template <class Work> void take(int thread, std::uint32_t phase, Work&& work) {
        for (std::size_t k = 0; k < shares_.size(); ++k) {
            Share& share = shares_[(static_cast<std::size_t>(thread) + k) % shares_.size()];
            for (std::size_t at; (at = claim(share, phase)) < share.size;)
                work(share.first + at);
        }
    }

private:
    struct alignas(64) Share {
        std::size_t first = 0, size = 0;     ///< items
        std::atomic<std::uint64_t> taken{0}; ///< how many, and above them in which phase
    };

    static std::size_t claim(Share& share, std::uint32_t phase) {
        std::uint64_t before = share.taken.load(std::memory_order_relaxed);
        for (;;) {
            const std::uint64_t at = before >> 32 == phase ? before & 0xffffffff : 0;
            if (at == share.size ||
                share.taken.compare_exchange_weak(before, (std::uint64_t{phase} << 32) + at + 1,
                                                  std::memory_order_relaxed))
                return at;
        }
    }

    std::vector<Share> shares_;
};

/// Keeps the calling thread on one core while it lives, if `threads` threads are to fill all cores:
/// the kernel likes to wake a team's threads on the core of the first, where they wait for each
/// other.
class Pinned {
public:
    Pinned(int thread, int threads);
    ~Pinned();
    Pinned(const Pinned&) = delete;
    Pinned& operator=(const Pinned&) = delete;

private:
    std::vector<int> before_; ///< cores that the thread may use otherwise; empty: not pinned
};

} // namespace listric::dem
