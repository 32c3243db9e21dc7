#pragma once

#include "dem/base/rest.hpp"
#include "dem/columns.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/numbers/point.hpp"
#include "dem/state.hpp"

#include <span>

namespace listric::dem {

/// The motion that damping leaves alone: none, nor one that is remembered, where the wall rests.
class UndampedMotion {
public:
    UndampedMotion(State& state, const CyclePhysics& physics, Stretching thins, bool rests)
        : averages_(physics.averaging_time > 0.0 && !rests), thins_(thins) {
        if (!averages_)
            return;
        mean_vx_ = state.discs.get(columns::mean_vx);
        mean_vy_ = state.discs.get(columns::mean_vy);
        if (state.clock.cycle % averaging_interval == 0)
            weight_ = averaging_interval * state.clock.time_step / physics.averaging_time;
    }

    Point operator()(const DiscColumns& d, std::size_t i) const { // m/s
        if (averages_)
            return {mean_vx_[i], mean_vy_[i]};
        if (thins_.rate != 0.0)
            return {thins_.rate * d.x[i], -thins_.rate * (d.y[i] - thins_.floor)};
        return {0.0, 0.0};
    }

    /// Takes a sample of the disc's velocity.
    void learn(const DiscColumns& d, std::size_t i) {
        if (weight_ == 0.0)
            return;
        const double vx = mean_vx_[i], vy = mean_vy_[i];
        mean_vx_[i] = static_cast<float>(vx + (d.vx[i] - vx) * weight_);
        mean_vy_[i] = static_cast<float>(vy + (d.vy[i] - vy) * weight_);
    }

private:
    bool averages_;
    Stretching thins_;
    std::span<float> mean_vx_, mean_vy_;
    double weight_ = 0.0; ///< of a sample in the mean
};

} // namespace listric::dem
