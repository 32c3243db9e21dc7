#pragma once

#include <span>
#include <vector>

namespace listric::measures {

// A seismic trace by the convolution of reflectivity with a wavelet: vertical incidence, primary
// reflections only; no diffraction, no multiples, no noise, no loss with distance.

/// Laws of velocity and density of rock by its porosity. Defaults: sandstone with water.
struct SeismicLaw {
    double matrix_velocity = 5500.0; ///< m/s
    double fluid_velocity = 1500.0;  ///< m/s
    double grain_density = 2650.0;   ///< kg/m3
    double fluid_density = 1000.0;   ///< kg/m3
    double weak_factor = 0.85;       ///< of the velocity of weakened rock, which is cracked
    double contrast = 0.05;          ///< share by which layers are faster and slower, by turns
};

/// Rock for a wave.
struct SeismicRock {
    double velocity = 0.0; ///< m/s
    double density = 0.0;  ///< kg/m3

    double impedance() const { return velocity * density; }
};

/// Rock of a porosity by the time average, 1/v = (1 - porosity)/v_matrix + porosity/v_fluid
/// (Wyllie, Gregory & Gardner 1956, Geophysics 21, 41-70), and the mean density.
SeismicRock saturated_rock(const SeismicLaw& law, double porosity);

/// A layer that a vertical ray passes.
struct SeismicLayer {
    double thickness = 0.0; ///< m
    SeismicRock rock;
};

/// The lower boundary of a layer.
struct Reflection {
    double depth = 0.0;       ///< m below the datum
    double time = 0.0;        ///< there and back, s
    double coefficient = 0.0; ///< (Z2 - Z1) / (Z2 + Z1); positive: the lower rock is harder
    double velocity = 0.0;    ///< of the layer above, m/s
};

/// Lays rock of a velocity (m/s) upon layers, so heavy that nothing reflects at their top: what is
/// between a datum and the ground, alike in all traces.
/// @param thickness  m
void cover(std::vector<SeismicLayer>& layers, double thickness, double velocity);

/// Boundaries of layers, from the datum down; the last layer has no end.
std::vector<Reflection> reflections(std::span<const SeismicLayer> layers);

/// Ricker's wavelet, zero phase, 1 at its middle.
/// @param time       s
/// @param frequency  at which its spectrum is highest, Hz
double ricker(double time, double frequency);

/// Period of Ricker's wavelet from one trough to the other, s: sqrt(6) / (pi frequency). A layer is
/// tuned, its two reflections of unlike sign are strongest together, where its two-way time is half
/// of this: where it is a quarter of that wavelength thick (Kallweit & Wood 1982, Geophysics 47,
/// 1035-1046; Chung & Lawton 1995, Geophysics 60, 823-829).
double ricker_period(double frequency);

/// Ricker's wavelet on its way through rock that takes high frequencies.
struct Wavelet {
    double frequency = 25.0; ///< at which its spectrum is highest at first, Hz
    double quality = 0.0;    ///< cycles over 2 pi in which a share of 1/e is lost; 0: no loss

    /// Where its spectrum is highest after a two-way time, Hz: it falls, and the wavelet is
    /// stretched (Zhang & Ulrych 2002, Geophysics 67, 1542-1547). Its height is kept.
    double frequency_at(double time) const;
};

/// Adds every reflection's wavelet to a trace whose samples are `interval` s apart, from 0.
/// @param start  two-way time of the first sample from where the reflections' times count, s
void add_reflections(std::span<float> trace, double interval,
                     std::span<const Reflection> reflections, const Wavelet& wavelet,
                     double start = 0.0);

/// Two-way time at a depth below the datum, s, in layers whose boundaries are given.
/// @param last  velocity below the last boundary, m/s
double time_at(std::span<const Reflection> reflections, double depth, double last);

/// Adds every reflection's wavelet to a trace whose samples are `interval` m of depth apart, each
/// at its two-way time.
void add_reflections_in_depth(std::span<float> trace, double interval,
                              std::span<const Reflection> reflections, double last,
                              const Wavelet& wavelet);

} // namespace listric::measures
