#pragma once

#include "apps/laboratory/sample.hpp"
#include "apps/scene/parameters/material_file.hpp"

#include <vector>

namespace listric {

/// One sample of a rock, compressed between frictionless platens [paper, Fig. 4a].
struct CompressionParameters {
    double confining = 0.0;      ///< stress on the sides, Pa, kept by a servo; 0: no walls there
    double strain_rate = 4e-5;   ///< axial, per model second
    double largest_strain = 0.1; ///< axial, at which a test ends that has not failed
};

/// A moment of a compression test. Compression is positive.
struct CompressionPoint {
    double axial_strain;   ///< of the platens, since the side stress was reached
    double axial_stress;   ///< mean of both platens, Pa
    double lateral_strain; ///< of the side walls, or of the sample where there are none; < 0 widens
    double lateral_stress; ///< on the side walls, Pa
    double gauge_axial, gauge_lateral; ///< strains of the sample's inner part, from its discs
    double broken;                     ///< share of the bonds
};

/// Bonds every contact of a sample, if the rock has bonds, and gives it the rock's friction; or
/// bonds it `unbreakably` [paper: "a network of strong contact-bonds is installed to prevent
/// plastic deformation"].
void consolidate(Specimen& sample, const RockMaterial& rock, bool unbreakably);

/// Compresses a sample without side walls by an axial strain of 5e-4.
std::vector<CompressionPoint> compress_elastically(Specimen sample, const CompressionParameters& p);

/// Loads a sample isotropically to the confining stress, then compresses it beyond its peak.
std::vector<CompressionPoint> compress_to_failure(Specimen sample, const CompressionParameters& p);

/// Elastic constants of a two-dimensional material, and of the rock whose plane strain it is:
/// nu = nu_2D / (1 + nu_2D), E = E_2D (1 + 2 nu_2D) / (1 + nu_2D)^2.
struct Elasticity {
    double young_2d = 0.0, poisson_2d = 0.0; ///< Pa, 1
    double poisson() const { return poisson_2d / (1.0 + poisson_2d); }
    double young() const {
        return young_2d * (1.0 + 2.0 * poisson_2d) / ((1.0 + poisson_2d) * (1.0 + poisson_2d));
    }
};

/// Slopes of stress and lateral strain over axial strain, least squares.
Elasticity elasticity(const std::vector<CompressionPoint>& curve);

/// The greatest axial stress, Pa, of means over a tenth of a percent of strain.
double peak_stress(const std::vector<CompressionPoint>& curve);

} // namespace listric
