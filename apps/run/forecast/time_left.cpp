#include "apps/run/forecast/time_left.hpp"
#include "dem/numbers/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace listric {

namespace {

/// Share of the work that counts as seen before the first cycle, at the forecast's pace: so much
/// must be seen until cycles weigh as much as the forecast.
constexpr double belief = 0.015;
constexpr double early = 0.05; ///< share of the cycles before which the forecast bounds

/// How many times its own seconds of the run a picture takes to be drawn: cycles go on beside it.
constexpr double picture_stretch = 1.5;

constexpr double few_cycles = 1e-5; ///< by which the end of a window may be off its share

} // namespace

/// Work up to a share of the cycles, in the forecast's seconds. A window that ends there is to
/// come: its work is seen by the next cycle.
double TimeLeft::work_until(double share) const {
    const double growth = forecast_.growth - 1.0;
    const double cycles = (share + 0.5 * growth * share * share) / (1.0 + 0.5 * growth);
    const double ended = (share - few_cycles - forecast_.ramp_share) / forecast_.window_share;
    const double all = (1.0 - forecast_.ramp_share) / forecast_.window_share;
    // A run of no cycles has neither share: all is not a number then.
    const double windows = all > 0.0 ? std::clamp(std::floor(ended) / all, 0.0, 1.0) : 0.0;
    double drawn = 0.0; // pictures
    for (const double begin : forecast_.pictures)
        drawn += std::clamp((share - begin) * forecast_.extension /
                                (picture_stretch * forecast_.picture),
                            0.0, 1.0);
    const double pictures = forecast_.picture * static_cast<double>(forecast_.pictures.size());
    return (forecast_.extension - forecast_.windows - pictures) * cycles +
           forecast_.windows * windows + forecast_.picture * drawn;
}

void TimeLeft::read(double done, double all, double clock) {
    const double share = all > 0.0 ? std::clamp(done / all, 0.0, 1.0) : 1.0;
    if (share_ < 0.0) {
        first_share_ = share;
        first_at_ = clock;
    }
    share_ = share;
    read_at_ = clock;
}

/// How many times longer things take than the forecast says, since the first cycle. No older
/// reading is forgotten: other programs come and go, and the last minute predicts no more.
double TimeLeft::pace() const {
    const double believed = belief * forecast_.extension;
    const double seen = believed + work_until(share_) - work_until(first_share_);
    return seen > 0.0 ? (believed + read_at_ - first_at_) / seen : 1.0;
}

/// Seconds of figures and report, another program's work, whose pace cycles tell in part: of the
/// powers of their pace that were tried, 3/4 fits recorded runs best.
double TimeLeft::figures() const { return dem::power(pace(), 0.75) * forecast_.after; }

double TimeLeft::at(double clock) const {
    if (share_ < 0.0)
        return std::max(0.0, forecast_.before - clock) + forecast_.extension + forecast_.after;
    if (ended_ >= 0.0)
        return std::max(0.0, figures() - (clock - ended_));
    const double extension = forecast_.extension - work_until(share_);
    // Figures begin after the last cycle.
    const double left = std::max(0.0, pace() * extension - (clock - read_at_)) + figures();
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
