#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#if defined __SSE2__
#include <immintrin.h>
#endif

namespace listric::dem {

/// Meeting point of a fixed number of threads. A cycle lasts about 0.1 ms and being woken takes as
/// long, so waiting spins for about that time; then it sleeps, or else two threads on a shared
/// machine would keep each other from the core that they wait for.
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
        for (int spins = 0; spins < 8000; ++spins) {
            if (round_.load(std::memory_order_acquire) != round)
                return;
            pause();
        }
        const auto before = std::chrono::steady_clock::now();
        round_.wait(round, std::memory_order_acquire);
        asleep_ += std::chrono::nanoseconds(std::chrono::steady_clock::now() - before).count();
    }

    /// How long threads have slept here, all together, s.
    double asleep() const { return 1e-9 * static_cast<double>(asleep_.load()); }

private:
    static void pause() {
#if defined __SSE2__
        _mm_pause();
#endif
    }

    const int threads_;
    alignas(64) std::atomic<int> arrived_ = 0;
    alignas(64) std::atomic<unsigned> round_ = 0;
    std::atomic<std::int64_t> asleep_ = 0; ///< ns
};

/// Work that the threads of a team take in phases which end at a barrier. Everyone begins with its
/// own and goes on with what nobody has begun, so that a thread without a core takes less.
class Claims {
public:
    explicit Claims(std::size_t items) : taken_(items) {}

    /// Calls work(item) for items that are free, from `own` on. Phases count from 1.
    template <class Work> void take(std::size_t own, unsigned phase, Work&& work) {
        for (std::size_t k = 0; k < taken_.size(); ++k) {
            const std::size_t item = (own + k) % taken_.size();
            std::atomic<unsigned>& taken = taken_[item].in_phase;
            unsigned before = taken.load(std::memory_order_relaxed);
            if (before != phase &&
                taken.compare_exchange_strong(before, phase, std::memory_order_relaxed))
                work(item);
        }
    }

private:
    struct alignas(64) Taken {
        std::atomic<unsigned> in_phase = 0; ///< the last
    };
    std::vector<Taken> taken_;
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

/// Calls work(k) for k = 0 .. threads - 1, each on a thread of its own, and waits for all. Threads
/// that meet at barriers would wait for ever for one that failed, or that could not be started:
/// among several that ends the program (std::terminate).
template <class Work> void run_team(int threads, Work&& work) {
    if (threads == 1)
        return work(0);
    std::vector<std::jthread> others;
    const auto take_part = [&work, threads](int k) noexcept {
        const Pinned pinned(k, threads);
        work(k);
    };
    [&]() noexcept {
        for (int k = 1; k < threads; ++k)
            others.emplace_back(take_part, k);
    }();
    take_part(0);
}

} // namespace listric::dem
