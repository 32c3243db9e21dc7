#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/measures/strata/horizons.hpp"
#include "apps/measures/strata/seismic_trace.hpp"
#include "apps/scene/parameters/effect.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace listric {

/// How a section is made to look as seismics would see it.
struct SeismicOptions {
    double frequency = 25.0; ///< of the wavelet's strongest part, Hz
    double lateral = 0.0;    ///< full width at half maximum of the point-spread function along x, m
    bool in_depth = false;   ///< samples by depth, else by two-way time
    double trace_spacing = 0.0;   ///< m; 0: that of the owner map, a quarter of a mean radius
    double sample_interval = 0.0; ///< whole us, in s, or whole mm, in m; 0: a tenth of the wavelet
    bool has_labels = false;      ///< strain and faults at every sample, too
    measures::SeismicLaw law = {};
};

/// Pre-rift porosity at the surface, of rock that was buried before; it decays with depth as that
/// of sediment does.
inline constexpr double pre_rift_porosity = 0.1, porosity_decay_per_m = 4e-4;

/// Traces side by side, from the breakaway to the right wall. Time and depth are 0 at the original
/// surface, y = 0, in every trace; where rock is above it the first sample has a negative time or
/// depth. The topmost rock reaches up to the first sample: neither its surface nor water above it
/// reflects.
struct SeismicSection {
    SeismicOptions options = {}; ///< with spacing and interval as they are
    std::size_t traces = 0, samples = 0;
    double first_x = 0.0;                 ///< m
    double first_sample = 0.0;            ///< whole ms, in s, or whole m of depth; 0 or less
    double top = 0.0;                     ///< y of the highest rock, whole m up; 0 at least
    std::vector<double> ground = {};      ///< y of the topmost rock, m, trace by trace
    std::vector<float> amplitude = {};    ///< trace by trace
    std::vector<float> strain = {};       ///< of window_strain(); NaN outside rock, too
    std::vector<std::uint8_t> fault = {}; ///< 1 within a mean diameter of an active fault

    double x(std::size_t trace) const {
        return first_x + options.trace_spacing * static_cast<double>(trace);
    }
    /// Two-way time from the original surface, s, or depth below it, m.
    double sample(std::size_t k) const {
        return first_sample + options.sample_interval * static_cast<double>(k);
    }
};

/// Reflectivity of the section by velocity and density of its rock, convolved with Ricker's
/// wavelet: no migration, no noise. Layers are those between the horizons; they are faster and
/// slower by turns, as the model gives them no rock of their own. Porosity of sediment is that of
/// its discs, averaged over a disc's surroundings; of pre-rift rock it falls with the depth of the
/// layer at the start. Weakened discs are slower, each by itself.
/// @param faults    for labels
/// @param horizons  of seismic_horizons()
SeismicSection seismic_section(const Observation& now, std::span<const measures::Fault> faults,
                               std::span<const measures::Horizon> horizons,
                               const SeismicOptions& options);

/// Horizons that a section needs: tops of strata and of pre-rift rock by its depth at the start,
/// where rock has layers, too.
std::vector<measures::Horizon> seismic_horizons(const Observation& now);
/// Those that are traced already, where they are no boundaries of layers of rock.
std::vector<measures::Horizon> seismic_horizons(const Observation& now,
                                                std::vector<measures::Horizon> traced);

/// Whether seismics make sense of a model: it is a kilometre thick or more.
bool has_seismics(const Scene& scene);

} // namespace listric
