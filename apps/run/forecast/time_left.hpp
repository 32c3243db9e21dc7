#pragma once

#include <vector>

namespace listric {

/// Time that a run is expected to take, s, before anything of it has been seen.
struct Forecast {
    double before = 0.0;       ///< hanging wall and base, until the first cycle
    double extension = 0.0;    ///< cycles, events and windows, from the first cycle to the last
    double after = 0.0;        ///< figures and report, after the last cycle
    double growth = 1.0;       ///< price of the last cycle over that of the first: discs are added
    double windows = 0.0;      ///< part of the extension that goes at the ends of windows, s
    double window_share = 1.0; ///< of the cycles in a window
    double ramp_share = 0.0;   ///< of the cycles that the first window has more, for the ramp
    double picture = 0.0;      ///< part of the extension that one picture drawn beside it takes, s
    std::vector<double> pictures = {}; ///< shares of the cycles at which they begin

    double all() const { return before + extension + after; }
};

/// How long a run has to go, from its forecast and readings of a clock. The clock's 0 is the
/// beginning of the session; cycles of earlier sessions count as done.
class TimeLeft {
public:
    explicit TimeLeft(const Forecast& forecast = {}) : forecast_(forecast) {}

    /// Takes a reading: cycles done of all that the run has, and the clock, s.
    void read(double done, double all, double clock);

    /// Says that the last cycle is done.
    void end_extension(double clock) { ended_ = clock; }

    /// Seconds to go at a clock's reading: the forecast of the work to come times the pace of the
    /// work that was seen, where the forecast counts as if 1.5 % of the run had been seen before.
    /// Never more than twice the forecast before 5 % of the cycles have been seen.
    double at(double clock) const;

    /// Share of the run's work that is done at a clock's reading, by the forecast.
    double share_done(double clock) const;

private:
    double work_until(double share) const;
    double pace() const;
    double figures() const;

    Forecast forecast_;
    double share_ = -1.0;                       ///< of cycles; < 0: no cycle has been seen
    double read_at_ = 0.0;                      ///< clock of the last reading, s
    double first_share_ = 0.0, first_at_ = 0.0; ///< the first reading
    double ended_ = -1.0;                       ///< clock at the last cycle; < 0: there are more
};

} // namespace listric
