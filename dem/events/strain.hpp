#pragma once

#include "dem/event.hpp"

#include <optional>
#include <vector>

namespace listric::dem {

/// Extension over which strain is measured, m.
inline constexpr double strain_window = 500.0;

/// Shear strain of the hanging wall, per window of extension and since the start.
///
/// Columns: window_strain (largest shear strain, gamma, of the last window) and total_strain (their
/// sum). The displacement gradient of a disc is a least-squares fit to its neighbours'
/// displacements within 2.6 mean diameters.
///
/// window_tectonic_strain and total_tectonic_strain are the same without the vertical strain of
/// compaction, which is as large a shear on planes that dip by 45 degrees: each neighbour's
/// displacement less the mean of its and the disc's own share, times their difference in height.
/// They are notes, and so is window_porosity, from which the share is taken. A run that an older
/// program began has no total of it.
class Strain : public Observer {
public:
    /// @param window  extension between updates, m
    Strain(double window, double extension_rate);

    void begin(State& state) override;
    bool apply(State& state, const RigidBase& base) override;
};

/// Largest shear strain of every disc since the last window began; 0 for discs deposited since.
std::vector<double> shear_strain(const State& state);

/// That without the vertical strain of compaction; none where an older program began the window,
/// which did not note the porosity.
std::optional<std::vector<double>> tectonic_strain(const State& state);

} // namespace listric::dem
