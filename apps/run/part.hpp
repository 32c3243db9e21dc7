#pragma once

#include "apps/support/stopwatch.hpp"

#include <map>
#include <string>

namespace listric {

/// Parts of a run's wall time, beside its events and the search for neighbours.
enum class Part { genesis, base, cycle, measures, output, figures, report };

/// Name of a part in `time_by_part_s`.
inline std::string name(Part part) {
    constexpr const char* names[] = {"genesis", "base",    "cycle", "measures",
                                     "output",  "figures", "report"};
    return names[static_cast<int>(part)];
}

/// Wall time of a run by part, s.
using SecondsByPart = std::map<std::string, double>;

inline double total(const SecondsByPart& seconds) {
    double sum = 0.0;
    for (const auto& [part, own] : seconds)
        sum += own;
    return sum;
}

/// Adds the wall time of its life to a part's, less what is counted for any part meanwhile.
class PartWatch {
public:
    PartWatch(SecondsByPart& seconds, Part part)
        : seconds_(seconds), sum_(seconds[name(part)]), before_(total(seconds)) {}
    ~PartWatch() { sum_ += seconds_since(start_) - (total(seconds_) - before_); }
    PartWatch(const PartWatch&) = delete;
    PartWatch& operator=(const PartWatch&) = delete;

private:
    const SecondsByPart& seconds_;
    double& sum_;
    double before_;
    SteadyClock::time_point start_ = SteadyClock::now();
};

} // namespace listric
