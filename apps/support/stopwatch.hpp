#pragma once

#include <chrono>

namespace listric {

using SteadyClock = std::chrono::steady_clock;

/// Wall time since a moment, s.
inline double seconds_since(SteadyClock::time_point start) {
    return std::chrono::duration<double>(SteadyClock::now() - start).count();
}

/// Adds the wall time of its life to a sum, s, which must outlive it.
class Stopwatch {
public:
    explicit Stopwatch(double& sum) : sum_(sum) {}
    ~Stopwatch() { sum_ += seconds_since(start_); }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    double& sum_;
    SteadyClock::time_point start_ = SteadyClock::now();
};

} // namespace listric
