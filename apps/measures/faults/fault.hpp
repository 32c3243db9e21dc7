#pragma once

#include "apps/measures/faults/fault_throw.hpp"
#include "apps/measures/faults/fault_trace.hpp"

#include <map>
#include <optional>
#include <vector>

namespace listric::measures {

/// A main fault dips by this at least, degrees.
inline constexpr double least_main_dip = 30.0;

/// Name of a fault at every moment: when it was traced for the first time, and which of the
/// lines of that moment it was, the longest being 0.
struct TraceName {
    dem::Travel travel;
    int index = 0;

    bool operator==(const TraceName&) const = default;
};

/// An active fault with its history (docs/reference/measures.md defines the numbers).
struct Fault {
    FaultTrace trace;
    TraceName name;              ///< two lines of one name are parts of one fault
    double dip = 0.0;            ///< of the best straight line, degrees
    bool normal = true;          ///< sense of slip in the last window; false: reverse
    bool synthetic = true;       ///< dips the way the detachment does at the breakaway
    double rate = 0.0;           ///< median slip rate along the trace, mm/a
    double width = 0.0;          ///< median along the trace, mean disc diameters
    double curvature = 0.0;      ///< 1/m, > 0: convex upward
    dem::Extension born_at;      ///< since which its place has been active
    dem::Travel born_travel;     ///< and when that was
    double dip_at_birth = 0.0;   ///< of the line traced in the first window since, degrees
    dem::Extension traced_since; ///< end of that window
    dem::Point foot_at_birth;    ///< of that line, as foot, m
    double footwall_turn = 0.0;  ///< rotation of the footwall block since birth, degrees, > 0
                                 ///< counter-clockwise: toward the detachment
    dem::Point foot;             ///< lower end, extended to the detachment if that is close, m
    /// By horizon; growth strata have them only where the fault has been followed to its birth.
    std::map<int, Cutoffs> cutoffs;
};

/// Properties that the faults of a state share.
struct FaultReport {
    std::vector<Fault> faults; ///< the longest first
    /// Index of the main fault: normal, as steep as least_main_dip, if possible reaching the lower
    /// half of the hanging wall, and of those the one with most slip rate times length.
    std::optional<std::size_t> main_antithetic, main_synthetic;
    std::optional<double> antithetic_foot; ///< x of the main antithetic fault's foot at birth,
                                           ///< less the extension from its birth to that line, m
    std::optional<double> width;           ///< median over faults by length, diameters
    std::optional<double> sediment_weak_off_fault_fraction;
    std::optional<double> weak_off_fault_fraction; ///< of what is weakened: weakened_rock.hpp
};

} // namespace listric::measures
