#pragma once

#include <algorithm>

namespace listric {

/// Moves a wall so that it presses with a wanted stress, as PFC2D's servo does: the speed is the
/// missing force over what the wall's contacts yield until the next adjustment. An integral part
/// lets no error remain while the sample yields steadily.
class Servo {
public:
    double gain = 0.5;      ///< PFC2D 3.x: 0.5
    double integral = 0.02; ///< share of the speed that is remembered per adjustment
    double fastest = 0.25;  ///< m/s

    /// Speed, m/s, toward the sample.
    /// @param missing  wanted less present force, N
    /// @param stiffness  of the wall's contacts together, N/m
    /// @param interval  until the next adjustment, s
    double speed(double missing, double stiffness, double interval) {
        const double wanted = gain * missing / (stiffness * interval);
        const double speed = wanted + memory_;
        if (speed > -fastest && speed < fastest)
            memory_ += integral * wanted;
        return std::clamp(speed, -fastest, fastest);
    }

private:
    double memory_ = 0.0;
};

} // namespace listric
