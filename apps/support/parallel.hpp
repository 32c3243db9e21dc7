#pragma once

#include <cstddef>
#include <functional>

namespace listric {

/// Calls work(k) for k = 0 .. count - 1, on several threads, or on fewer where there is no memory
/// for more. After a failure no further call begins; of what the calls have thrown, the first in
/// order of k is thrown again, whatever the threads.
void for_each_on_threads(std::size_t count, int threads,
                         const std::function<void(std::size_t)>& work);

} // namespace listric
