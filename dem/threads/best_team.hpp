#pragma once

namespace listric::dem {

/// How many threads a team is to have, by what it measures. A thread that does not get a core holds
/// up the others: on a shared machine fewer may do more. Where threads wait long fewer are tried, a
/// few times a second, and where they are fewer than they might be, more.
class BestTeam {
public:
    explicit BestTeam(int most) : most_(most), size_(most) {}

    int most() const { return most_; }
    int size() const { return trial_ > 0 ? trial_ : size_; }

    /// Work of some 20 ms, a good time between reports; of less at the beginning, so that a team
    /// that is too large for what the machine has free is not one for long.
    double piece() const;

    /// Work of a team of that size, its seconds, and how long its threads were asleep
    /// for each other, all together, s.
    void report(double work, double seconds, double asleep);

private:
    void end_trial(double speed);
    void begin_trial(bool crowded);

    int most_, size_;
    int trial_ = 0;                                    ///< the size that is tried; 0: none
    double window_ = 0.004;                            ///< that is looked at, s
    double speed_ = 0.0;                               ///< of size_, in its last window
    int patience_ = 1;                                 ///< windows from trial to trial
    int since_trial_ = 0;                              ///< windows
    double work_ = 0.0, seconds_ = 0.0, asleep_ = 0.0; ///< in this window
};

} // namespace listric::dem
