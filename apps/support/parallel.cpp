#include "apps/support/parallel.hpp"

#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace listric {

void for_each_on_threads(std::size_t count, int threads,
                         const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next = 0;
    std::vector<std::exception_ptr> failures(count);
    const auto take = [&] {
        for (std::size_t k; (k = next++) < count;)
            try {
                work(k);
            } catch (...) {
                failures[k] = std::current_exception();
            }
    };
    {
        std::vector<std::jthread> others;
        for (int t = 1; t < threads && static_cast<std::size_t>(t) < count; ++t)
            others.emplace_back(take);
        take();
    }
    for (const std::exception_ptr& failure : failures)
        if (failure)
            std::rethrow_exception(failure);
}

} // namespace listric
