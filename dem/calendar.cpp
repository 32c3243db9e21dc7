#include "dem/calendar.hpp"

#include "dem/numbers/round_off.hpp"

#include <algorithm>
#include <utility>

namespace listric::dem {

Calendar::Calendar(double rate, std::vector<SteppedPause> pauses)
    : rate_(rate), pauses_(std::move(pauses)) {}

double Calendar::age(Travel travel) const {
    double in_pauses = 0.0, elsewhere = travel.m;
    for (const SteppedPause& pause : pauses_) {
        const double past =
            std::clamp((travel - pause.start).m, 0.0, (pause.end() - pause.start).m);
        in_pauses += past / pause.step.m * pause.years;
        elsewhere -= past;
    }
    return in_pauses + elsewhere / rate_;
}

double Calendar::years(Travel from, Travel to) const {
    return pauses_.empty() ? (to - from).m / rate_ : age(to) - age(from);
}

Travel Calendar::travel(double age) const {
    Travel of_pauses; // that have ended
    double years = 0.0;
    for (const SteppedPause& pause : pauses_) {
        const double past = (age - this->age(pause.start)) / pause.years; // steps
        if (past <= 0.0)
            break;
        if (past < static_cast<double>(pause.steps))
            return pause.start + past * pause.step;
        of_pauses = of_pauses + (pause.end() - pause.start);
        years += static_cast<double>(pause.steps) * pause.years;
    }
    return of_pauses + Travel((age - years) * rate_);
}

double Calendar::metres_per_year(Travel travel) const {
    for (const SteppedPause& pause : pauses_)
        if (travel > pause.start && travel <= pause.end())
            return pause.step.m / pause.years;
    return rate_;
}

Travel Calendar::way_back(Travel now, double years) const {
    return pauses_.empty() ? Travel(without_round_off(years * rate_))
                           : now - travel(age(now) - years);
}

double Calendar::years_per_metre(double from, double to) const {
    std::vector<double> ends{from, to}; // of what is straight
    for (const SteppedPause& pause : pauses_)
        for (const Travel end : {pause.start, pause.end()})
            ends.push_back(std::clamp(age(end), from, to));
    std::ranges::sort(ends);
    double most = 0.0;
    for (std::size_t k = 1; k < ends.size(); ++k)
        if (ends[k] > ends[k - 1])
            most = std::max(most, 1.0 / metres_per_year(travel(0.5 * (ends[k - 1] + ends[k]))));
    return most;
}

} // namespace listric::dem
