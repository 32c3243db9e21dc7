#pragma once

// Ranks that are threads of one process.

#include "dem/ranks/ranks.hpp"

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace listric::support {

/// Blocks threads until all have come. std::barrier spins first, and here threads are more than
/// cores.
class Meeting {
public:
    explicit Meeting(int count) : count_(count), awaited_(count) {}

    void wait() {
        std::unique_lock lock(mutex_);
        const long now = round_;
        if (--awaited_ == 0) {
            awaited_ = count_;
            ++round_;
            all_here_.notify_all();
        } else {
            all_here_.wait(lock, [&] { return round_ != now; });
        }
    }

private:
    std::mutex mutex_;
    std::condition_variable all_here_;
    int count_, awaited_;
    long round_ = 0;
};

class EmulatedRanks {
public:
    explicit EmulatedRanks(int count)
        : count_(count), meeting_(count), bytes_(static_cast<std::size_t>(count)),
          messages_(static_cast<std::size_t>(count)), numbers_(static_cast<std::size_t>(count)),
          bits_(static_cast<std::size_t>(count)), sums_(static_cast<std::size_t>(count)) {}

    /// Calls root(ranks) in this thread and other(ranks) in one for each of the others.
    template <class Root, class Other> void run(Root&& root, Other&& other) {
        std::vector<std::thread> threads;
        for (int mine = 1; mine < count_; ++mine)
            threads.emplace_back([this, mine, &other] {
                One one(*this, mine);
                other(one);
            });
        One one(*this, 0);
        root(one);
        for (std::thread& thread : threads)
            thread.join();
    }

    std::size_t exchanged = 0; ///< numbers that the root has sent to others, in all
    std::size_t exchanges = 0; ///< of messages between all

private:
    class One : public dem::Ranks {
    public:
        One(EmulatedRanks& all, int mine) : all_(all), mine_(mine) {}

        int count() const override { return all_.count_; }
        int mine() const override { return mine_; }

        void connect(std::span<const std::size_t> sent,
                     std::span<const std::size_t> received) override {
            sent_.assign(sent.begin(), sent.end());
            received_.assign(received.begin(), received.end());
        }
        void begin_exchange(std::span<const double> sent, std::span<double> received) override {
            std::vector<std::vector<double>>& numbers = of(all_.numbers_);
            numbers.clear();
            std::size_t at = 0;
            for (const std::size_t size : sent_) {
                const auto part = sent.subspan(at, size);
                numbers.emplace_back(part.begin(), part.end());
                at += size;
            }
            if (mine_ == 0)
                all_.exchanged += sent.size();
            to_ = received;
            wait();
        }
        void end_exchange() override {
            std::size_t at = 0;
            for (std::size_t rank = 0; rank < received_.size(); ++rank) {
                const auto& part = all_.numbers_[rank][static_cast<std::size_t>(mine_)];
                if (part.size() != received_[rank])
                    std::abort();
                std::ranges::copy(part, to_.subspan(at).begin());
                at += part.size();
            }
            wait();
        }
        void greatest(std::span<std::uint64_t> numbers) override {
            fold(all_.bits_, numbers,
                 [](std::uint64_t a, std::uint64_t b) { return std::max(a, b); });
        }
        void sum(std::span<std::int64_t> numbers) override {
            fold(all_.sums_, numbers, [](std::int64_t a, std::int64_t b) { return a + b; });
        }
        void broadcast(dem::Bytes& bytes) override {
            if (mine_ == 0)
                of(all_.bytes_) = bytes;
            wait();
            bytes = all_.bytes_[0];
            wait();
        }
        std::vector<dem::Bytes> all_to_all(std::vector<dem::Bytes> messages) override {
            of(all_.messages_) = std::move(messages);
            if (mine_ == 0)
                ++all_.exchanges;
            wait();
            std::vector<dem::Bytes> received;
            for (const auto& sent : all_.messages_)
                received.push_back(sent[static_cast<std::size_t>(mine_)]);
            wait();
            return received;
        }
        void gather(dem::Bytes message, const Take& take) override {
            of(all_.bytes_) = std::move(message);
            wait();
            if (mine_ == 0)
                for (int rank = 0; rank < all_.count_; ++rank)
                    take(rank, all_.bytes_[static_cast<std::size_t>(rank)]);
            wait();
        }
        dem::Bytes scatter(const Make& make) override {
            if (mine_ == 0)
                for (int rank = all_.count_; rank-- > 0;) // the root's comes last
                    all_.bytes_[static_cast<std::size_t>(rank)] = make(rank);
            wait();
            dem::Bytes result = of(all_.bytes_);
            wait();
            return result;
        }
        void abort(int) override { std::abort(); }

    private:
        template <class T> T& of(std::vector<T>& by_rank) {
            return by_rank[static_cast<std::size_t>(mine_)];
        }
        void wait() { all_.meeting_.wait(); }

        template <class T, class Add>
        void fold(std::vector<std::vector<T>>& by_rank, std::span<T> numbers, Add&& add) {
            of(by_rank).assign(numbers.begin(), numbers.end());
            wait();
            for (std::size_t k = 0; k < numbers.size(); ++k) {
                T all = by_rank[0][k];
                for (std::size_t rank = 1; rank < by_rank.size(); ++rank)
                    all = add(all, by_rank[rank][k]);
                numbers[k] = all;
            }
            wait();
        }

        EmulatedRanks& all_;
        int mine_;
        std::vector<std::size_t> sent_, received_;
        std::span<double> to_; ///< by the exchange that has begun
    };

    int count_;
    Meeting meeting_;
    std::vector<dem::Bytes> bytes_;                         ///< by rank
    std::vector<std::vector<dem::Bytes>> messages_;         ///< by rank, to rank
    std::vector<std::vector<std::vector<double>>> numbers_; ///< by rank, to rank
    std::vector<std::vector<std::uint64_t>> bits_;
    std::vector<std::vector<std::int64_t>> sums_;
};

} // namespace listric::support
