#pragma once

#include <optional>

namespace listric {

/// Targets of a rock.
struct CalibrationTargets {
    double young = 50e9;    ///< plane strain, Pa
    double poisson = 0.25;  ///< plane strain
    double friction = 0.6;  ///< slope of the strength envelope in shear over normal stress
    double cohesion = 10e6; ///< Pa
    bool byerlee = false;   ///< Byerlee's law instead of friction and cohesion
    std::optional<double> bulk_friction; ///< of the weakened rock in the shear box

    /// Throws UsageError if no discs can be such a rock.
    void check() const;
};

} // namespace listric
