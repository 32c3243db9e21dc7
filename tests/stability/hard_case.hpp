#pragma once

// Checks that all hard cases share: how fast discs move, whether all are where they may be, and
// that a restart in the middle changes nothing.

#include "apps/archive/snapshot/snapshot.hpp"
#include "dem/contacts/monitor.hpp"
#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace listric::support {

using namespace dem;

/// Greatest speed of a disc, m/s; NaN if one is no number.
inline double fastest(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    double greatest = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double speed = std::hypot(d.vx[i], d.vy[i]) + d.radius[i] * std::abs(d.spin[i]);
        if (!(speed <= greatest))
            greatest = speed;
    }
    return greatest;
}

/// Discs whose centre is beyond a surface.
inline int escaped(const State& state, const RigidBase& base) {
    const ConstDiscColumns d = disc_columns(state);
    int count = 0;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        count += std::ranges::any_of(base.surfaces, [&](const Surface& s) {
            const auto foot = nearest(s, state.clock.extension.m, {d.x[i], d.y[i]});
            return foot && !(foot->distance > 0.0);
        });
    return count;
}

/// Greatest overlap of two discs, over the sum of their radii.
inline double deepest(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    double greatest = 0.0;
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]);
        const auto j = static_cast<std::size_t>(c.second[k]);
        greatest = std::max(greatest, 1.0 - std::hypot(d.x[j] - d.x[i], d.y[j] - d.y[i]) /
                                                (d.radius[i] + d.radius[j]));
    }
    return greatest;
}

inline double total_mass(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    return std::accumulate(d.mass.begin(), d.mass.end(), 0.0);
}

/// The state as a snapshot gives it back.
inline State restarted(const State& state) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) /
                                       ("listric-hard-" + std::to_string(getpid()) + ".h5");
    archive::write_snapshot(file, state, {}, {});
    State again = archive::read_snapshot(file).state;
    std::filesystem::remove(file);
    return again;
}

/// Advances with a restart from a snapshot in the middle, which must change nothing.
inline void advance_with_restart(State& state, const RigidBase& base, const CyclePhysics& physics,
                                 std::int64_t cycles, const Execution& execution = {}) {
    State uninterrupted = state;
    advance(uninterrupted, base, physics, cycles, execution);
    advance(state, base, physics, cycles / 2, execution);
    state = restarted(state);
    advance(state, base, physics, cycles - cycles / 2, execution);
    EXPECT_EQ(hash(state), hash(uninterrupted)) << "after a restart";
}

} // namespace listric::support
