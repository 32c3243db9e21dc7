// The elastic footwall against fields that are known everywhere: the patch test and orders of
// convergence on the curved mesh.

#include "tests/verification/footwalls.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace listric::fem_convergence_test {

namespace {

using namespace support;
using fem::Boundary;
using fem::Vector;

/// A displacement with its first and second derivatives.
struct Known {
    Vector u;
    double ux_x, ux_y, uy_x, uy_y;
    double ux_xx, ux_xy, ux_yy, uy_xx, uy_xy, uy_yy;
};

/// Loads under which a uniform footwall takes the shape `known`, but for the force on the end of
/// its detachment.
template <class Field> fem::Load load_for(const fem::FootwallRequest& request, Field known) {
    const double e = request.layers[0].young_modulus, nu = request.layers[0].poisson_ratio;
    const double mu = e / (2.0 * (1.0 + nu)), lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
    fem::Load load;
    load.body = [=](Vector p) { // - div sigma
        const Known k = known(p);
        return Vector{-((lambda + 2 * mu) * k.ux_xx + lambda * k.uy_xy + mu * (k.ux_yy + k.uy_xy)),
                      -((lambda + 2 * mu) * k.uy_yy + lambda * k.ux_xy + mu * (k.ux_xy + k.uy_xx))};
    };
    load.traction = [=](Vector p, Vector n, Boundary boundary) {
        const Known k = known(p);
        const double trace = lambda * (k.ux_x + k.uy_y), shear = mu * (k.ux_y + k.uy_x);
        const double spring = boundary == Boundary::base         ? request.base_spring
                              : boundary == Boundary::surface    ? request.surface_spring
                              : boundary == Boundary::detachment ? request.detachment_spring
                                                                 : 0.0;
        const double turned = boundary == Boundary::detachment ? spring * p.y : 0.0;
        return Vector{(trace + 2 * mu * k.ux_x) * n.x + shear * n.y +
                          (boundary == Boundary::detachment ? spring * n.x * k.u.y : 0.0) -
                          turned * (k.uy_x * n.y - k.uy_y * n.x),
                      shear * n.x + (trace + 2 * mu * k.uy_y) * n.y +
                          spring * std::abs(n.y) * k.u.y + turned * (k.ux_x * n.y - k.ux_y * n.x)};
    };
    return load;
}

/// Load on a footwall whose detachment ends free: the rock's pressure is cut off there.
template <class Field>
fem::Load load_with_end(const fem::FootwallRequest& request, const fem::Footwall& footwall,
                        Field known) {
    fem::Load load = load_for(request, known);
    const Vector end = footwall.interface().back().place;
    load.interface.assign(2 * footwall.interface().size(), 0.0);
    load.interface[load.interface.size() - 2] = request.detachment_spring * end.y * known(end).u.y;
    return load;
}

template <class Field> fem::ExactField exact(Field known) {
    return {[=](Vector p) { return known(p).u; },
            [=](Vector p) {
                const Known k = known(p);
                return std::array{k.ux_x, k.ux_y, k.uy_x, k.uy_y};
            }};
}

/// Waves of 30 and 25 km that have no horizontal displacement on the sides, which have rollers.
Known wave(Vector p) {
    const double a = 2.0 * std::numbers::pi / 37.5e3, b = 2.0 * std::numbers::pi / 25e3;
    const double sx = std::sin(a * (p.x + 30e3)), cx = std::cos(a * (p.x + 30e3));
    const double sy = std::sin(b * p.y + 0.3), cy = std::cos(b * p.y + 0.3);
    const double x = 100.0, y = 150.0; // amplitudes, m
    return {{x * sx * cy, y * cx * sy}, x * a * cx * cy,      -x * b * sx * sy,
            -y * a * sx * sy,           y * b * cx * cy,      -x * a * a * sx * cy,
            -x * a * b * cx * sy,       -x * b * b * sx * cy, -y * a * a * cx * sy,
            -y * a * b * sx * cy,       -y * b * b * cx * sy};
}

/// Uniform strain; the left side does not move sideways, the right one is pulled free.
Known linear(Vector p) {
    const double strain_x = 2e-3, strain_y = -1e-3, rise = 3e-4;
    return {{strain_x * (p.x + 30e3), rise * (p.x + 30e3) + strain_y * p.y + 5.0},
            strain_x,
            0.0,
            rise,
            strain_y,
            0,
            0,
            0,
            0,
            0,
            0};
}

struct Shape {
    const char* name;
    std::vector<fem::Piece> detachment;
    int degree;
};

class Patch : public testing::TestWithParam<int> {};

TEST_P(Patch, UniformStrainIsExact) {
    const Shape shapes[] = {
        {"listric", listric_detachment(), 1},
        {"listric", listric_detachment(), 2},
        {"ramp-flat-ramp", ramp_flat_ramp(), 2},
        {"low angle", detachment(std::numbers::pi / 6, {{60e3, std::numbers::pi / 6}}), 2}};
    const Shape& shape = shapes[GetParam()];
    fem::FootwallRequest request = small_footwall();
    request.degree = shape.degree;
    request.right_side = fem::Side::free;
    request.detachment = shape.detachment;
    const auto footwall = fem::make_footwall(request);
    footwall->solve(load_with_end(request, *footwall, linear));
    const fem::FieldError error = footwall->error(exact(linear));
    std::printf("%s, Q%d: %.1e, %.1e\n", shape.name, shape.degree, error.l2, error.h1);
    // Round-off times the condition of the stiffness (springs 1e-5 of the rock's).
    EXPECT_LT(error.l2, 1e-10);
    EXPECT_LT(error.h1, 1e-10);
}

/// Strain 2e-3 and -1e-3 with a shear of 3e-4 / 2: Mohr's circle about 5e-4.
TEST(Guard, OfAUniformStrain) {
    fem::FootwallRequest request = small_footwall();
    request.right_side = fem::Side::free;
    request.cell_size = 1000.0;
    const auto footwall = fem::make_footwall(request);
    footwall->solve(load_with_end(request, *footwall, linear));
    const double radius = 0.5 * std::hypot(3e-3, 3e-4);
    const fem::Guard guard = footwall->guard(2.7e4);
    EXPECT_NEAR(guard.strong_strain, 5e-4 + radius, 1e-11); // errors of 1e-10 of the solution
    EXPECT_NEAR(guard.rotation, 1.5e-4, 1e-11);
    EXPECT_EQ(guard.relaxed_strain, 0.0); // no rock is relaxed

    // 20 GPa of mu and lambda: tension of 40 MPa on lithostatic pressure, shear stress of 40 GPa
    // times the radius. Byerlee's first line, tau = 0.85 sigma_n, is crossed above a depth d:
    const double shear = 40e9 * radius;
    const double d = (shear * std::hypot(1.0, 0.85) / 0.85 + 40e6) / 2.7e4, r = 15e3;
    const double beside_the_arc =
        d * (30e3 + r) - 0.5 * (d * std::sqrt(r * r - d * d) + r * r * std::asin(d / r));
    std::printf("beyond Byerlee %.4g, above %.0f m %.4g m2\n", guard.beyond_byerlee, d,
                beside_the_arc);
    // Counted at points that stand for a third of a kilometre's height, of five.
    EXPECT_NEAR(guard.beyond_byerlee, beside_the_arc, 0.03 * beside_the_arc);
    EXPECT_EQ(footwall->guard(1e9).beyond_byerlee, 0.0); // rock so heavy that nothing slides
}

INSTANTIATE_TEST_SUITE_P(Footwall, Patch, testing::Range(0, 4));

class Order : public testing::TestWithParam<int> {};

TEST_P(Order, OnTheCurvedMesh) {
    const int degree = GetParam();
    fem::FootwallRequest request = small_footwall();
    request.degree = degree;
    request.cell_size = 2000.0;
    fem::FieldError coarse{};
    double l2_order = 0.0, h1_order = 0.0;
    const int finest = degree == 1 ? 2 : 1;
    for (request.refinements = 0; request.refinements <= finest; ++request.refinements) {
        const auto footwall = fem::make_footwall(request);
        footwall->solve(load_for(request, wave));
        const fem::FieldError error = footwall->error(exact(wave));
        if (request.refinements > 0) {
            l2_order = std::log2(coarse.l2 / error.l2);
            h1_order = std::log2(coarse.h1 / error.h1);
        }
        coarse = error;
        std::printf("Q%d, %zu unknowns: L2 %.3e (order %.3f), H1 %.3e (order %.3f)\n", degree,
                    footwall->mesh().unknowns, error.l2, l2_order, error.h1, h1_order);
    }
    // The theory's orders; the asymptotic range is reached to 0.1 on these meshes.
    EXPECT_NEAR(l2_order, degree + 1, 0.1);
    EXPECT_NEAR(h1_order, degree, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Footwall, Order, testing::Values(1, 2));

} // namespace
} // namespace listric::fem_convergence_test
