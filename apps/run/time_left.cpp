#include "apps/run/time_left.hpp"

#include <algorithm>
#include <cmath>

namespace listric {

namespace {

/// Shares of the run's cycles: seen before anything follows from it, seen once all does, and that
/// over which what was seen is forgotten, long enough for several windows.
constexpr double too_few = 0.005, enough = 0.06, memory = 0.25;
constexpr double early = 0.05; ///< share before which the forecast bounds

} // namespace

/// Work up to a share of the cycles, in the forecast's seconds.
double TimeLeft::work_until(double share) const {
    const double growth = forecast_.growth - 1.0;
    return forecast_.extension * (share + 0.5 * growth * share * share) / (1.0 + 0.5 * growth);
}

void TimeLeft::read(double done, double all, double clock) {
    const double share = all > 0.0 ? std::clamp(done / all, 0.0, 1.0) : 1.0;
    if (share_ < 0.0) {
        first_share_ = share;
    } else {
        const double kept = std::exp(-(share - share_) / memory);
        work_ = work_ * kept + work_until(share) - work_until(share_);
        seconds_ = seconds_ * kept + clock - read_at_;
    }
    share_ = share;
    read_at_ = clock;
}

/// How many times longer things take than the forecast says.
double TimeLeft::pace() const {
    const double seen = share_ - first_share_;
    const double weight = std::clamp((seen - too_few) / (enough - too_few), 0.0, 1.0);
    return work_ > 0.0 ? 1.0 + weight * (seconds_ / work_ - 1.0) : 1.0;
}

double TimeLeft::at(double clock) const {
    if (share_ < 0.0)
        return std::max(0.0, forecast_.before - clock) + forecast_.extension + forecast_.after;
    if (ended_ >= 0.0)
        return std::max(0.0, pace() * forecast_.after - (clock - ended_));
    const double extension = work_until(1.0) - work_until(share_);
    const double left = pace() * (extension + forecast_.after) - (clock - read_at_);
    const double most = share_ - first_share_ < early ? 2.0 * forecast_.all() : left;
    return std::clamp(left, 0.0, std::max(0.0, most));
}

double TimeLeft::share_done(double clock) const {
    double done = std::min(clock, forecast_.before);
    if (share_ >= 0.0)
        done = forecast_.before + work_until(share_);
    if (ended_ >= 0.0)
        done += std::min(clock - ended_, forecast_.after);
    return done / std::max(1e-9, forecast_.all());
}

} // namespace listric
