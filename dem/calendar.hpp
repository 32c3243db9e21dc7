#pragma once

#include "dem/clocks.hpp"

#include <cstdint>
#include <vector>

namespace listric::dem {

/// A pause that goes by steps: as many years each, in as much travel as rest takes.
struct SteppedPause {
    Travel start, step;
    std::int64_t steps;
    double years; ///< of a step

    Travel end() const { return start + static_cast<double>(steps) * step; }
};

/// The age of a run by its travel: straight, at the rate of extension and, in pauses that go by
/// steps, at theirs. All that goes by years asks it.
class Calendar {
public:
    /// @param rate    of extension, m/a. A bare rate is a calendar.
    /// @param pauses  one after the other
    Calendar(double rate, std::vector<SteppedPause> pauses = {});

    double rate() const { return rate_; }
    const std::vector<SteppedPause>& pauses() const { return pauses_; }

    double age(Travel travel) const;                      ///< a since extension began
    double years(Travel from, Travel to) const;           ///< a between two travels
    Travel travel(double age) const;                      ///< at which the run is so old
    Travel way_back(Travel now, double years) const;      ///< travel of the last years
    double metres_per_year(Travel travel) const;          ///< of travel, on the way to it
    double years_per_metre(double from, double to) const; ///< greatest between two ages

private:
    double rate_;
    std::vector<SteppedPause> pauses_;
};

} // namespace listric::dem
