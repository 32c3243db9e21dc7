#include "apps/support/parallel.hpp"

#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace listric {

void for_each_on_threads(std::size_t count, int threads,
                         const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> has_failed = false;
    std::vector<std::exception_ptr> failures(count);
    // Calls begin in order: whatever fails first in time, those before it in order have begun.
    const auto take = [&] {
        for (std::size_t k; !has_failed && (k = next++) < count;)
            try {
                work(k);
            } catch (...) {
                failures[k] = std::current_exception();
                has_failed = true;
            }
    };
    {
        std::vector<std::jthread> others;
        try {
            for (int t = 1; t < threads && static_cast<std::size_t>(t) < count; ++t)
                others.emplace_back(take);
        } catch (const std::system_error&) {
            // those that could be started do it
        }
        take();
    }
    for (const std::exception_ptr& failure : failures)
        if (failure)
            std::rethrow_exception(failure);
}

} // namespace listric
