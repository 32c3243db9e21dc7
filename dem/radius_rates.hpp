#pragma once

#include "dem/columns.hpp"
#include "dem/state.hpp"

#include <span>

namespace listric::dem {

/// Lets radii change with every cycle: columns `radius_rate`, m/s, at most 0 since lists must hold,
/// and `inertial_radius`, m, that of the moment of inertia. Both are for events to set: what a
/// cycle depends on changes with the state alone, not with where calls are cut.
inline void add_radius_rates(State& state) {
    state.discs.add(columns::radius_rate);
    state.discs.add_like(columns::inertial_radius, columns::radius);
}

/// The columns of add_radius_rates(), or what they stand for where there are none.
class RadiusRates {
public:
    explicit RadiusRates(const State& state) {
        if (!state.discs.has(columns::radius_rate))
            return;
        rate_ = state.discs.get(columns::radius_rate);
        inertial_radius_ = state.discs.get(columns::inertial_radius);
    }

    bool any() const { return !rate_.empty(); }

    double operator[](std::size_t i) const { return rate_.empty() ? 0.0 : rate_[i]; } ///< m/s

    double of_inertia(std::size_t i, double radius) const { ///< m
        return inertial_radius_.empty() ? radius : inertial_radius_[i];
    }

private:
    std::span<const double> rate_, inertial_radius_;
};

} // namespace listric::dem
