// Flexure of an elastic layer on springs, against the exact solution of the layer and against the
// thin plate, whose own error is part of the comparison.

#include "fem/elastic_layer.hpp"
#include "fem/plate.hpp"
#include "tests/verification/footwalls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace listric::fem_flexure_test {

namespace {

using namespace support;
using fem::Boundary;
using fem::Vector;

constexpr double restoring = 3300.0 * standard_gravity;

fem::ElasticLayer exact_layer(const fem::FootwallRequest& request) {
    return {request.layers[0].young_modulus, request.layers[0].poisson_ratio, request.depth,
            request.surface_spring, request.base_spring};
}

fem::Plate plate(double thickness) { return {70e9, 0.25, thickness, restoring}; }

/// Downward deflection of the layer's middle under a pressure on the surface.
fem::Field middle_under(const fem::FootwallRequest& request,
                        const std::function<double(double)>& pressure) {
    const auto footwall = fem::make_footwall(request);
    fem::Load load;
    load.traction = [&](Vector p, Vector, Boundary boundary) {
        return boundary == Boundary::surface ? Vector{0.0, -pressure(p.x)} : Vector{};
    };
    footwall->solve(load);
    return row(footwall->field(), -0.5 * request.depth, 1.0);
}

/// Its part with |x| below a bound.
fem::Field within(const fem::Field& field, double bound) {
    fem::Field part;
    for (std::size_t k = 0; k < field.place.size(); ++k)
        if (std::abs(field.place[k].x) < bound) {
            part.place.push_back(field.place[k]);
            part.displacement.push_back(field.displacement[k]);
        }
    return part;
}

double wave_error(fem::FootwallRequest request, double wavelength) {
    request.left = 0.0;
    request.right = wavelength;
    const double q = 2.0 * std::numbers::pi / wavelength;
    const fem::Field middle =
        middle_under(request, [&](double x) { return 1e7 * std::cos(q * x); });
    const double amplitude = 1e7 * exact_layer(request).response(q, 0.5 * request.depth);
    double worst = 0.0;
    for (std::size_t k = 0; k < middle.place.size(); ++k)
        worst = std::max(worst, std::abs(-middle.displacement[k].y -
                                         amplitude * std::cos(q * middle.place[k].x)));
    return worst / amplitude;
}

TEST(Flexure, WaveOnALayerIsExactWithFourCells) {
    const double error = wave_error(layer(10e3, 0.0, 1.0, 2500.0), 100e3);
    std::printf("Te 10 km, 100 km, four Q2 cells: %.2e\n", error);
    EXPECT_LT(error, 1e-4); // discretisation: fourth order in the deflection
    fem::FootwallRequest split = layer(10e3, 0.0, 1.0, 2500.0);
    split.surface_spring = 2700.0 * standard_gravity;
    split.base_spring = 600.0 * standard_gravity;
    EXPECT_LT(wave_error(split, 100e3), 1e-4);
}

TEST(Flexure, LongWavesAreThoseOfThePlate) {
    // The plate neglects shear: its error is of the order of (Te / wavelength)^2. These are the
    // exact layer's amplitudes over the plate's.
    const fem::ElasticLayer layer{70e9, 0.25, 10e3, 0.0, restoring};
    const auto plate_error = [&](double wavelength) {
        const double exact = layer.response(2.0 * std::numbers::pi / wavelength, 5e3);
        return std::abs(plate(10e3).sinusoid(0.0, 1.0, wavelength) / exact - 1.0);
    };
    EXPECT_NEAR(plate_error(400e3), 0.004, 0.002);
    EXPECT_NEAR(plate_error(100e3), 0.06, 0.02);
    // The rest is the squeezing of the layer's upper half, restoring * Te / 2 E.
    EXPECT_LT(plate_error(4000e3), 3e-3);
}

class Thickness : public testing::TestWithParam<double> {};

TEST_P(Thickness, LineLoad) {
    const double te = GetParam();
    const fem::Plate thin = plate(te);
    const double side = 10.0 * thin.alpha(); // compared within 5: mirror images add e^-15
    fem::FootwallRequest request = layer(te, -side, side, te / 8.0);
    request.surface_breaks = {0.0};
    const auto footwall = fem::make_footwall(request);
    constexpr double v = 1e12;
    const fem::PointForce force{{0.0, 0.0}, {0.0, -v}};
    fem::Load load;
    load.interface = footwall->nodal_forces({&force, 1});
    footwall->solve(load);
    const fem::Field middle = within(row(footwall->field(), -0.5 * te, 1.0), 0.5 * side);
    std::vector<double> x;
    for (const Vector& p : middle.place)
        x.push_back(p.x);
    const std::vector<double> exact =
        exact_layer(request).deflection(x, 0.5 * te, [](double) { return v; });
    const double w0 = *std::ranges::max_element(exact);
    double worst = 0.0, bulge = 0.0, exact_bulge = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        worst = std::max(worst, std::abs(-middle.displacement[k].y - exact[k]));
        bulge = std::max(bulge, middle.displacement[k].y);
        exact_bulge = std::max(exact_bulge, -exact[k]);
    }
    std::printf("Te %g km: alpha %.2f km, w0 %.2f m, plate %.2f m (%.1f %%), layer and elements "
                "%.1e of w0, bulge %.2f m, plate %.2f m\n",
                te / 1e3, thin.alpha() / 1e3, w0, thin.line(0.0, v),
                100.0 * (thin.line(0.0, v) / w0 - 1.0), worst / w0, bulge,
                0.0432 * thin.line(0, v));
    EXPECT_LT(worst / w0, 1e-4);                 // the force's singularity is four elements away
    EXPECT_NEAR(bulge / exact_bulge, 1.0, 2e-3); // the same error, of a height of 0.04 w0
    // Shear, which the plate neglects, adds a few percent, more where alpha / Te is less.
    EXPECT_NEAR(thin.line(0.0, v) / w0, 1.0, 0.06);
    EXPECT_NEAR(footwall->reaction().y / v, 1.0, 1e-10); // equilibrium to round-off
}

TEST_P(Thickness, BrokenPlate) {
    const double te = GetParam();
    const fem::Plate thin = plate(te);
    constexpr double v = 1e12;
    fem::FootwallRequest request = layer(te, 0.0, 7.0 * thin.alpha(), te / 4.0);
    request.left_side = fem::Side::free;
    const auto bend = [&] {
        const auto footwall = fem::make_footwall(request);
        fem::Load load; // a beam's parabola of shear, so that nothing is singular
        load.traction = [&](Vector p, Vector, Boundary boundary) {
            const double s = -p.y / te;
            return boundary == Boundary::left ? Vector{0.0, -0.5 * v / te * 6.0 * s * (1.0 - s)}
                                              : Vector{};
        };
        footwall->solve(load);
        return row(footwall->field(), -0.5 * te, 1.0);
    };
    const fem::Field coarse = bend();
    request.refinements = 1;
    const fem::Field fine = bend();
    const double w0 = -fine.displacement.front().y;
    std::printf("Te %g km, broken: w0 %.3f m, plate %.3f m (%.1f %%), refinement %.1e\n", te / 1e3,
                w0, thin.broken(0.0, v), 100.0 * (thin.broken(0.0, v) / w0 - 1.0),
                std::abs(-coarse.displacement.front().y / w0 - 1.0));
    EXPECT_NEAR(-coarse.displacement.front().y / w0, 1.0, 1e-4); // fourth order
    EXPECT_NEAR(thin.broken(0.0, v) / w0, 1.0, 0.10); // shear is strongest at a loaded end
    // Far from the end it is the plate's again, to its error in alpha.
    for (std::size_t k = 0; k < fine.place.size(); ++k)
        EXPECT_NEAR(-fine.displacement[k].y, thin.broken(fine.place[k].x, v), 0.10 * w0);
}

TEST_P(Thickness, StripLoad) {
    const double te = GetParam();
    const fem::Plate thin = plate(te);
    constexpr double half_width = 20e3, pressure = 2600.0 * standard_gravity * 2000.0;
    const double side = half_width + 10.0 * thin.alpha(); // as above
    fem::FootwallRequest request = layer(te, -side, side, te / 4.0);
    request.surface_breaks = {-half_width, half_width};
    const fem::Field middle =
        middle_under(request, [&](double x) { return std::abs(x) < half_width ? pressure : 0.0; });
    std::vector<double> x;
    for (const Vector& p : middle.place)
        x.push_back(p.x);
    const std::vector<double> exact = exact_layer(request).deflection(
        x, 0.5 * te, [&](double q) { return 2.0 * pressure * std::sin(q * half_width) / q; });
    const double w0 = *std::ranges::max_element(exact);
    double worst = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k)
        worst = std::max(worst, std::abs(-middle.displacement[k].y - exact[k]));
    std::printf("Te %g km, strip: w0 %.2f m, plate %.2f m (%.1f %%), layer and elements %.1e\n",
                te / 1e3, w0, thin.strip(0.0, pressure, half_width),
                100.0 * (thin.strip(0.0, pressure, half_width) / w0 - 1.0), worst / w0);
    EXPECT_LT(worst / w0, 2e-4); // the pressure's jump is at a node
    EXPECT_NEAR(thin.strip(0.0, pressure, half_width) / w0, 1.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Flexure, Thickness, testing::Values(5e3, 10e3, 20e3));

TEST(Plate, LoadsAnywhereAndCut) {
    const fem::Plate thin = plate(10e3);
    using enum fem::PlateKind;
    // At the cut: the textbook's two plates, each with half the load.
    const fem::LineLoads end{{0.0}, {1e12}};
    for (const double x : {0.0, 7e3, 50e3}) {
        EXPECT_NEAR(thin.deflection(x, end, continuous), thin.line(x, 1e12), 1e-9);
        EXPECT_NEAR(thin.deflection(x, end, broken), thin.broken(x, 1e12), 1e-9);
        EXPECT_NEAR(thin.deflection(-x, end, broken), thin.broken(x, 1e12), 1e-9);
    }
    // Betti: what a load elsewhere does to the cut, one at the cut does there.
    const fem::LineLoads beside{{20e3}, {1e12}};
    EXPECT_NEAR(thin.deflection(0.0, beside, broken), thin.broken(20e3, 1e12), 1e-9);
    // No moment at the cut, and the whole load is carried.
    const double h = 10.0;
    const auto w = [&](double x) { return thin.deflection(x, beside, broken); };
    const double curvature = (w(2 * h) - 2.0 * w(h) + w(0.0)) / (h * h);
    EXPECT_LT(std::abs(curvature * thin.rigidity()), 2e-3 * 1e12 * thin.alpha());
    double carried = 0.0;
    for (double x = -1000e3 + 50.0; x < 1000e3; x += 100.0)
        carried += 100.0 * thin.restoring * w(x);
    EXPECT_NEAR(carried / 1e12, 1.0, 1e-6);
    // A strip is many lines.
    fem::LineLoads strip;
    for (double x = -20e3 + 50.0; x < 20e3; x += 100.0) {
        strip.x.push_back(x);
        strip.load.push_back(100.0 * 5e7);
    }
    EXPECT_NEAR(thin.deflection(3e3, strip, continuous) / thin.strip(3e3, 5e7, 20e3), 1.0, 1e-5);
}

TEST(Plate, ThicknessIsFoundFromTheDeflection) {
    const fem::LineLoads loads{{3e3, 12e3, 30e3}, {8e11, 5e11, -2e11}};
    for (const double te : {2e3, 10e3, 40e3})
        for (const fem::PlateKind kind : {fem::PlateKind::continuous, fem::PlateKind::broken}) {
            std::vector<double> x, w;
            for (double at = 0.0; at < 60e3; at += 1e3) {
                x.push_back(at);
                w.push_back(plate(te).deflection(at, loads, kind));
            }
            const fem::PlateFit fit = fem::fit_thickness(plate(5e3), loads, kind, x, w);
            EXPECT_NEAR(fit.thickness / te, 1.0, 1e-6);
            EXPECT_LT(fit.misfit, 1e-6);
        }
}

TEST(Flexure, NearlyIncompressibleRockBends) {
    fem::FootwallRequest request = layer(10e3, 0.0, 1.0, 2500.0);
    request.layers[0].poisson_ratio = 0.4999;
    const double quadratic = wave_error(request, 200e3);
    request.degree = 1;
    const double linear = wave_error(request, 200e3);
    std::printf("nu 0.4999, four cells: Q2 %.1e, Q1 %.1e\n", quadratic, linear);
    EXPECT_LT(quadratic, 1e-3); // no locking
    EXPECT_GT(linear, 0.1);     // what locking looks like
}

TEST(Flexure, StripOnAHalfSpace) {
    // Flamant's solution, integrated over the strip: at the surface
    // w(x) = const - 2 (1 - nu^2) p / (pi E) [(b + x) ln |b + x| + (b - x) ln |b - x|].
    constexpr double b = 1e3, pressure = 1e6, size = 400.0 * b;
    fem::FootwallRequest request = layer(size, -size, size, size / 8.0);
    request.surface_breaks = {-b, b};
    const auto footwall = fem::make_footwall(request);
    fem::Load load;
    load.traction = [&](Vector p, Vector, Boundary boundary) {
        return boundary == Boundary::surface && std::abs(p.x) < b ? Vector{0.0, -pressure}
                                                                  : Vector{};
    };
    const auto fall = [&](double x) { // deflection at the centre less that at x
        const double nu = 0.25,
                     factor = 2.0 * (1.0 - nu * nu) * pressure / (std::numbers::pi * 70e9);
        const auto term = [&](double s) { return s == 0.0 ? 0.0 : s * std::log(std::abs(s)); };
        return factor * (term(b + x) + term(b - x) - 2.0 * term(b));
    };
    double error = 0.0;
    for (int step = 0; step < 12; ++step) {
        footwall->solve(load);
        const fem::Field top = row(footwall->field(), 0.0, 1e-3);
        const auto at = [&](double x) {
            const auto k = std::ranges::min_element(top.place, {},
                                                    [x](Vector p) { return std::abs(p.x - x); });
            return std::pair(k->x,
                             -top.displacement[static_cast<std::size_t>(k - top.place.begin())].y);
        };
        const auto [x0, w0] = at(0.0);
        const auto [x, w] = at(4.0 * b);
        error = std::abs((w0 - w) / (fall(x) - fall(x0)) - 1.0);
        if (step < 11)
            footwall->refine(0.15);
    }
    std::printf("Flamant: %.1e with %zu cells\n", error, footwall->mesh().cells);
    // The half space ends after 400 half-widths: (4 / 400)^2 and what rollers and springs bend.
    EXPECT_LT(error, 2e-3);
}

} // namespace
} // namespace listric::fem_flexure_test
