#include "dem/threads/best_team.hpp"

#include <algorithm>

namespace listric::dem {

namespace {

constexpr double longest_window = 0.05;   ///< s, some slices of the system's scheduler
constexpr double crowded_from = 0.1;      ///< share of a team's time that it waits in
constexpr double faster = 1.03;           ///< than noise
constexpr double shortest_window = 0.004; ///< s, at the beginning and for what is hopeless
constexpr double hopeless = 0.5;          ///< of the speed before, in a trial
constexpr double slower = 0.8;            ///< another program has begun
/// Windows between trials. A trial of two threads against another program loses a quarter of a
/// window, one of one thread on a quiet machine half of it.
constexpr int least_patience = 8, most_patience = 64;

} // namespace

void BestTeam::report(double work, double seconds, double asleep) {
    work_ += work;
    seconds_ += seconds;
    asleep_ += asleep;
    const double speed = work_ / seconds_;
    const bool is_hopeless = trial_ > 0 && seconds_ > shortest_window && speed < hopeless * speed_;
    if (seconds_ < window_ && !is_hopeless)
        return;
    window_ = std::min(longest_window, 2.0 * window_);
    const bool crowded = asleep_ > crowded_from * seconds_ * size();
    work_ = seconds_ = asleep_ = 0.0;
    if (trial_ > 0) {
        const int before = size_;
        end_trial(speed);
        if (crowded && size_ != before)
            patience_ = 1; // the next step is due
        return;
    }
    if (crowded && speed < slower * speed_)
        patience_ = 1;
    speed_ = speed;
    if (++since_trial_ >= patience_)
        begin_trial(crowded);
}

double BestTeam::piece() const {
    if (speed_ == 0.0)
        return 5e4;
    // A larger team on a crowded machine may take twenty times as long.
    return (trial_ > size_ ? 0.04 : 0.4) * window_ * speed_;
}

void BestTeam::end_trial(double speed) {
    if (speed > faster * speed_) {
        size_ = trial_;
        speed_ = speed;
        patience_ = least_patience;
    } else {
        patience_ = std::clamp(2 * patience_, least_patience, most_patience);
    }
    trial_ = since_trial_ = 0;
}

void BestTeam::begin_trial(bool crowded) {
    const int step = 1 + size_ / 4;
    if (crowded && size_ > 1)
        trial_ = std::max(1, size_ - step);
    else if (size_ < most_)
        trial_ = std::min(most_, size_ + step);
}

} // namespace listric::dem
