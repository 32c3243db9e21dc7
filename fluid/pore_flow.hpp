#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace listric::fluid {

// Flow of pore water through geological time: implicit Euler for the water of every cell,
//
//     storage(u) - water = seconds (sum T (u_j - u_i) - D u_i) - vented,
//
// with an excess pressure u of at most `highest`, at which water leaves as it must, and of at least
// `lowest`, at which pores are not full.

/// Two cells that water flows between.
struct FlowLink {
    std::int32_t first, second;
    double conductance; ///< T, m^2/s per Pa and metre of thickness; of either sign, so long as the
                        ///< matrix of all is not negative
};

/// Cells and how water gets from one to the other and out.
struct FlowNetwork {
    std::vector<FlowLink> links;
    std::vector<double> drains; ///< D by cell, to where u is 0; 0: none

    std::size_t cells() const { return drains.size(); }
};

/// Water that a cell holds at a pressure, m^2, and the derivative by it, above 0.
struct Stored {
    double water, slope;
};
using Storage = std::function<Stored(std::size_t cell, double excess_pressure)>;

/// Allowed excess pressures by cell, Pa.
struct PressureBounds {
    std::vector<double> lowest, highest;
    /// What leaves at the highest there does so through the ground, not through fractures. Empty:
    /// nowhere.
    std::vector<bool> at_ground = {};
};

/// Water that has left, m^2, and what the solution took.
struct FlowOutcome {
    double surface = 0.0; ///< through drains
    double vented = 0.0;
    int steps = 0;                         ///< of Newton's method
    std::optional<std::size_t> stuck = {}; ///< cell where it did not converge, if so
};

/// Excess pressures after a time, and the water that is left, from those before. Water is what
/// flows have left, not what the pressure stands for, so that none is lost by a solution that ends
/// early.
///
/// Semi-smooth Newton's method with a line search, once steps do no good, on what is missing in the
/// water, where cells at their bounds count by what they are beyond them. It ends when no pressure
/// changes by more than 1 Pa and what is missing is at most 1e-12 of all water, or round-off. After
/// 16 steps the time is halved.
FlowOutcome flow(const FlowNetwork& network, const Storage& storage, const PressureBounds& bounds,
                 double seconds, std::span<double> water, std::span<double> excess_pressure);

} // namespace listric::fluid
