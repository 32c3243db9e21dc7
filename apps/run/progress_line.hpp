#pragma once

#include <cstddef>
#include <ctime>
#include <optional>
#include <string>

namespace listric {

/// How far a run is, or many are, for people.
struct Progress {
    double share = 0.0;              ///< of its work, from 0 to 1
    std::string what = {};           ///< "4.7 of 10 km"
    std::optional<double> left = {}; ///< s; none: not known yet
    std::time_t now = 0;
};

/// "[#####-----] 47 %  4.7 of 10 km  4 min left (ends 09:31)", with the local time. Where that
/// takes more than `columns`, the end's time is left out, then half of the bar, then all of it.
std::string progress_line(const Progress& progress, std::size_t columns);

} // namespace listric
