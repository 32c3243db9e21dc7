#pragma once

#include "dem/cycle_physics.hpp"
#include "dem/event.hpp"

#include <optional>
#include <vector>

namespace listric::dem {

// Does sediment carry its weight? Vertical forces in the column of discs between x = 2.5 and 5 km,
// in layers 1 km high whose middles lie 1, 2, ..., 7 km below the column's mean surface.
//
// A layer weighs the vertical momentum of every disc by w = a b: a, the share of the disc's width
// that is in the column; b, the share of the layer's height that is below its centre, so 1 above
// the layer and 0 below. By summation by parts, with f the vertical force of a contact on its upper
// disc,
//
//     sum w (m g) = sum f (b_upper - b_lower) (a_upper + a_lower) / 2     contacts in the layer
//                 + sum w (local damping's force)                         damping
//                 + what is left: shear on the column's sides, support by a base above the layer,
//                   inertia.
//
// The first is the virial of the contacts times the layer's height, branches cut at the layer's
// edges, so over the left side it is the mean vertical contact stress in the layer over the mean
// weight above its points.

inline constexpr double column_from = 2500.0, column_to = 5000.0; ///< m from the breakaway
inline constexpr double layer_height = 1000.0;                    ///< m
inline constexpr int layers = 7;

/// Vertical forces on the discs above a layer, N per metre of thickness, positive upward.
struct LayerLoad {
    double weight = 0.0; ///< of discs less the lift of their pushes, positive downward
    double contacts = 0.0, damping = 0.0;
    bool is_sediment = false; ///< sediment discs cover more than half of the layer
};

/// Loads of the layers, from the top down.
std::vector<LayerLoad> layer_loads(const State& state, const RigidBase& base,
                                   const CyclePhysics& physics);

/// Means of a layer over a window, ratios to the weight above.
struct LayerStress {
    double depth;                            ///< of its middle, m
    double ratio;                            ///< of what contacts carry
    std::optional<double> after_event_ratio; ///< ratio after compactions
    double damping_share;                    ///< of what local damping carries
};

/// Samples the layers' loads.
///
/// Some sixteen times in a window, at phases that cover the interval between two compactions evenly
/// (they are what shakes sediment most), and as often at phases that cover the first half metre of
/// extension after a compaction. All of them are set by the schedules alone.
///
/// Its memory has a row per layer: sums over the samples of the window that has begun last,
/// `window` its number.
class SedimentStress : public Observer {
public:
    /// @param window      extension that means are taken over, m
    /// @param compaction  extension between compactions, m; none: nothing is compacted
    SedimentStress(double window, std::optional<double> compaction, double extension_rate,
                   const CyclePhysics& physics);

    Travel next_due() const override;
    bool begins_any_time() const override { return true; }
    bool apply(State& state, const RigidBase& base) override;

    /// Means of the layers that have been sediment in the last window.
    std::vector<LayerStress> profile() const;

private:
    bool is_after_event() const { return compaction_ && applied % 2 == 0; }

    double window_;
    std::optional<double> compaction_;
    CyclePhysics physics_;
};

} // namespace listric::dem
