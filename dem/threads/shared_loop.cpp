#include "dem/threads/shared_loop.hpp"

#include "dem/threads/pause.hpp"
#include "dem/threads/team.hpp"

#include <cassert>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

namespace listric::dem {

using Work = std::function<void(std::size_t)>;

#if defined __wasi__

/// A module in a page has no threads: the caller does all.
class Team::Helpers {
public:
    void start(std::size_t) {}
    int count() const { return 0; }
    void share(std::size_t count, const Work& work) {
        for (std::size_t k = 0; k < count; ++k)
            work(k);
    }
};

#else

/// Threads that wait for loops to help with.
class Team::Helpers {
public:
    /// Starts threads until there are `count`.
    void start(std::size_t count) {
        try {
            while (can_start_ && threads_.size() < count)
                threads_.emplace_back([this](const std::stop_token& stop) { help(stop); });
        } catch (const std::system_error&) {
            can_start_ = false; // those that could be started do it
        }
    }

    int count() const { return static_cast<int>(threads_.size()); }

    /// The calling thread makes the first call.
    void share(std::size_t count, const Work& work) {
        std::unique_lock lock(mutex_);
        work_ = &work;
        count_ = count;
        next_ = 0;
        failures_.assign(count, nullptr);
        begins_.notify_all();
        while (next_ < count_)
            take_one(lock);
        // A helper that has not begun is not waited for.
        look_out(lock, [&] { return busy_ == 0; });
        ends_.wait(lock, [&] { return busy_ == 0; });
        for (const std::exception_ptr& failure : failures_)
            if (failure)
                std::rethrow_exception(failure);
    }

private:
    void help(const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        const auto is_there = [&] { return next_ < count_; };
        while (begins_.wait(lock, stop, is_there)) {
            take_one(lock);
            look_out(lock, is_there);
        }
    }

    /// Waits awake for about as long as it takes to fall asleep and be woken, for loops follow each
    /// other.
    template <class Done> static void look_out(std::unique_lock<std::mutex>& lock, Done done) {
        constexpr std::chrono::microseconds longest{50};
        const auto begin = std::chrono::steady_clock::now();
        while (!done() && std::chrono::steady_clock::now() - begin < longest) {
            lock.unlock();
            for (int k = 0; k < 20; ++k)
                pause();
            lock.lock();
        }
    }

    /// Calls begin in order: whatever fails first in time, those before it in order have begun.
    void take_one(std::unique_lock<std::mutex>& lock) {
        const std::size_t k = next_++;
        ++busy_;
        lock.unlock();
        std::exception_ptr failure;
        try {
            (*work_)(k);
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        if (failure) {
            failures_[k] = failure;
            next_ = count_;
        }
        if (--busy_ == 0)
            ends_.notify_one();
    }

    std::mutex mutex_;
    std::condition_variable_any begins_, ends_;
    const Work* work_ = nullptr;
    std::size_t next_ = 0, count_ = 0;
    int busy_ = 0;
    bool can_start_ = true;
    std::vector<std::exception_ptr> failures_;
    std::vector<std::jthread> threads_; ///< the last, so that they end first
};

#endif

namespace {

thread_local Team* team_at_hand = nullptr;

} // namespace

Team::Team(int threads) : threads_(threads), before_(team_at_hand) {
    if (threads < 1)
        throw std::invalid_argument("Execution::threads is " + std::to_string(threads) +
                                    "; at least 1 (std::thread::hardware_concurrency() is 0 where "
                                    "the number of cores is unknown)");
    team_at_hand = this;
}

Team::~Team() { team_at_hand = before_; }

Team::Helpers& Team::helpers(std::size_t pieces) {
    if (before_ && before_->threads_ == threads_)
        return before_->helpers(pieces);
    if (!helpers_)
        helpers_ = std::make_unique<Helpers>();
    helpers_->start(std::min(pieces, static_cast<std::size_t>(threads_)) - 1);
    return *helpers_;
}

int team_size() { return team_at_hand ? team_at_hand->threads_ : 1; }

int threads_at_hand(std::size_t pieces) {
    if (team_size() == 1 || pieces <= 1)
        return 1;
    const int started = 1 + team_at_hand->helpers(pieces).count();
    return static_cast<int>(std::min(pieces, static_cast<std::size_t>(started)));
}

void run_team(int threads, const std::function<void(int)>& work) {
    if (threads == 1)
        return work(0);
    const auto count = static_cast<std::size_t>(threads);
    assert(threads == threads_at_hand(count));
    // NOLINTNEXTLINE(bugprone-exception-escape): a team of one does not throw
    team_at_hand->helpers(count).share(count, [&](std::size_t k) noexcept {
        const Team alone(1);
        const Pinned pinned(static_cast<int>(k), threads);
        work(static_cast<int>(k));
    });
}

void for_each_shared(std::size_t count, const Work& work) {
    if (count > 1 && team_size() > 1)
        return team_at_hand->helpers(count).share(count, [&](std::size_t k) {
            const Team alone(1);
            work(k);
        });
    for (std::size_t k = 0; k < count; ++k)
        work(k);
}

} // namespace listric::dem
