#include "apps/laboratory/compression.hpp"

#include "apps/laboratory/envelope.hpp"

#include <gtest/gtest.h>

namespace listric::compression_test {

using namespace dem;
namespace {

TEST(Compression, ByerleeInPrincipalStresses) {
    // sigma_1 = (sqrt(mu^2 + 1) + mu)^2 sigma_3 + 2 c (sqrt(mu^2 + 1) + mu), the lesser branch.
    EXPECT_NEAR(fem::byerlee_axial(10e6), 46.8e6, 0.1e6);
    EXPECT_NEAR(fem::byerlee_axial(100e6), 467.6e6, 0.1e6);
    EXPECT_NEAR(fem::byerlee_axial(200e6), 835.7e6, 0.2e6);
}

TEST(Compression, EnvelopeFitFindsTheLineItWasMadeOf) {
    const fem::CoulombLine line{0.6, 10e6};
    const std::vector<double> confining{10e6, 50e6, 200e6};
    std::vector<double> axial;
    for (double s : confining)
        axial.push_back(line.axial(s));
    const fem::CoulombLine found = fit_envelope(confining, axial);
    EXPECT_NEAR(found.friction, 0.6, 1e-9);
    EXPECT_NEAR(found.cohesion, 10e6, 1.0);
}

TEST(Compression, PlaneStrainConstantsInvertTheTwoDimensionalOnes) {
    const double young = 50e9, poisson = 0.25;
    const Elasticity e{young / (1.0 - poisson * poisson), poisson / (1.0 - poisson)};
    EXPECT_NEAR(e.young(), young, 1.0);
    EXPECT_NEAR(e.poisson(), poisson, 1e-12);
}

TEST(Compression, PeakIsAMeanOverATenthOfAPercent) {
    std::vector<CompressionPoint> curve;
    for (int k = 0; k < 100; ++k)
        curve.push_back({1e-4 * k, k == 50 ? 2e6 : 1e6, 0.0, 0.0, 0.0, 0.0, 0.0});
    EXPECT_NEAR(peak_stress(curve), 1.1e6, 1.0);
}

} // namespace
} // namespace listric::compression_test
