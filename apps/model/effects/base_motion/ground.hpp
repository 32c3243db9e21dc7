#pragma once

#include "dem/event.hpp"

#include <optional>

// What the slip of a basement fault makes of the top of the rock above it.

namespace listric::effects::base_motion {

/// The fault as it has slipped.
struct SlippedFault {
    dem::Point foot;     ///< where it meets the base of the cover, on the left block, m
    double dip = 0.0;    ///< to the right, rad
    double slip = 0.0;   ///< of the right block down the dip, m; below 0: up
    double height = 0.0; ///< of the ground above the base at the start, m

    double throw_of_slip() const; ///< m, without sign
};

/// At an extension, m; none where no fault cuts the base.
std::optional<SlippedFault> slipped_fault(const dem::RigidBase& base, double extension);

/// A step in the displacement of the top of the rock, between means three mean diameters wide that
/// are five apart.
struct GroundStep {
    double size = 0.0; ///< m
    double x = 0.0;    ///< m
};

/// Remembers, for every tenth of a mean diameter that the fault slips, the greatest step at the
/// ground in that window.
class GroundRecord final : public dem::Observer {
public:
    /// @param slip  of the fault over the travel
    GroundRecord(double slip, double mean_radius, double rate);

    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    /// Share of the slip of the last window that is on one step at the ground, and where.
    std::optional<double> share() const;
    std::optional<double> x() const;

    /// Slip at which the fault broke the surface, and where: from then on two windows in succession
    /// have had half of their slip on one step. None before.
    std::optional<GroundStep> breakthrough() const;
};

/// The fold of the ground, by vertical displacement since the start.
struct Monocline {
    std::optional<double> width; ///< between a tenth and nine tenths of the throw, m; none: neither
    double slope = 0.0;          ///< greatest over five mean diameters, degrees
};
Monocline measure_monocline(const dem::State& state, const SlippedFault& fault);

} // namespace listric::effects::base_motion
