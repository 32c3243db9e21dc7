#pragma once

#include <cstddef>
#include <functional>

namespace listric {

/// Calls work(k) for k = 0 .. count - 1, on several threads. All calls are made, whichever throws;
/// then the first exception in order of k is thrown again.
void for_each_on_threads(std::size_t count, int threads,
                         const std::function<void(std::size_t)>& work);

} // namespace listric
