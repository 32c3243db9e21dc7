#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/measures/strata/horizons.hpp"
#include "apps/measures/strata/seismic_trace.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "dem/numbers/random.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace listric {

/// Purposes of random numbers besides those of dem, whose hash tells its physics.
namespace purposes {
inline constexpr auto seismic_contrast = static_cast<dem::Purpose>(100);
inline constexpr auto seismic_choice = static_cast<dem::Purpose>(101);
inline constexpr auto seismic_noise = static_cast<dem::Purpose>(102);
} // namespace purposes

/// How a section is made to look as seismics would see it.
struct SeismicOptions {
    double frequency = 25.0; ///< of the wavelet's strongest part, Hz
    double quality = 0.0;    ///< of rock, which stretches the wavelet on its way; 0: no loss
    double lateral = 0.0;    ///< full width at half maximum of the point-spread function along x, m
    bool in_depth = false;   ///< samples by depth, else by two-way time
    double trace_spacing = 0.0;   ///< m; 0: that of the owner map, a quarter of a mean radius
    double sample_interval = 0.0; ///< whole us, in s, or whole mm, in m; 0: a tenth of the wavelet
    bool has_labels = false;      ///< strain, faults and layers at every sample, too
    bool total_strain = false;    ///< the label is strain since the start, not of a window
    double pre_rift_layer = 0.0;  ///< thickness of those of pre-rift rock, m; 0: as elsewhere
    /// Of layers' contrasts, normally distributed; none: faster and slower by turns.
    std::optional<std::uint64_t> contrast_seed = {};
    measures::SeismicLaw law = {};
};

/// Pre-rift porosity at the surface, of rock that was buried before; it decays with depth as that
/// of sediment does.
inline constexpr double pre_rift_porosity = 0.1, porosity_decay_per_m = 4e-4;

/// Traces side by side, from the breakaway to the right wall. Time and depth are 0 at the original
/// surface, y = 0, in every trace; where rock is above it the first sample has a negative time or
/// depth. Above the ground all traces are as fast as fresh sediment, or as rock at the surface
/// where there is none, as after a correction to a datum: neither ground nor water reflects.
struct SeismicSection {
    SeismicOptions options = {}; ///< with spacing and interval as they are
    std::size_t traces = 0, samples = 0;
    double first_x = 0.0;                 ///< m
    double first_sample = 0.0;            ///< whole ms, in s, or whole m of depth; 0 or less
    double top = 0.0;                     ///< y of the highest rock, whole m up; 0 at least
    std::vector<double> ground = {};      ///< y of the topmost rock, m, trace by trace
    std::vector<float> amplitude = {};    ///< trace by trace
    std::vector<float> strain = {};       ///< as asked for; NaN outside rock, too
    std::vector<std::uint8_t> fault = {}; ///< 1 within a mean diameter of an active fault
    /// Number of the layer, that of the horizon on its top; below_rock in the footwall.
    std::vector<std::int16_t> layer = {};
    static constexpr std::int16_t below_rock = std::numeric_limits<std::int16_t>::min();

    std::vector<std::vector<measures::Reflection>> rays = {}; ///< of each trace, from the top down
    std::vector<double> zero = {}; ///< two-way time from the top to the original surface, s
    double last_velocity = 0.0;    ///< of the footwall, m/s

    double x(std::size_t trace) const {
        return first_x + options.trace_spacing * static_cast<double>(trace);
    }
    /// Two-way time from the original surface, s, or depth below it, m.
    double sample(std::size_t k) const {
        return first_sample + options.sample_interval * static_cast<double>(k);
    }
    /// y of a sample, m, and back: the sample of a height, with its fraction.
    double height(std::size_t trace, std::size_t k) const;
    double sample_at(std::size_t trace, double y) const;
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
/// @param pre_rift_layer  as that of the options
std::vector<measures::Horizon> seismic_horizons(const Observation& now,
                                                double pre_rift_layer = 0.0);
/// Those that are traced already, where they are no boundaries of layers of rock.
std::vector<measures::Horizon> seismic_horizons(const Observation& now,
                                                std::vector<measures::Horizon> traced);

/// Whether seismics make sense of a model: it is a kilometre thick or more.
bool has_seismics(const Scene& scene);

} // namespace listric
