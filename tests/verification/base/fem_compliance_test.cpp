// The footwall condensed to its interface, and forces on it.

#include "dem/numbers/random.hpp"
#include "tests/support.hpp"
#include "tests/verification/footwalls.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

namespace listric::fem_compliance_test {

namespace {

using namespace support;
using fem::Vector;

/// LIS1 with a strong upper crust of 10 km, a relaxed lower crust and a skin.
fem::FootwallRequest lis1_footwall(double cell_size) {
    fem::FootwallRequest request;
    request.detachment = listric_detachment();
    request.surface_spring = request.detachment_spring = 2700.0 * standard_gravity;
    request.base_spring = 600.0 * standard_gravity;
    request.elastic_thickness = 10e3;
    request.skin_thickness = 3e3;
    request.cell_size = cell_size;
    request.interface_end = 60e3;
    return request;
}

std::vector<double> times(const std::vector<double>& matrix, const std::vector<double>& x) {
    std::vector<double> y(x.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < x.size(); ++j)
            y[i] += matrix[i * x.size() + j] * x[j];
    return y;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double square = 0.0, size = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        square += std::pow(a[k] - b[k], 2);
        size += b[k] * b[k];
    }
    return std::sqrt(square / size);
}

TEST(Compliance, IsTheFullSolution) {
    const auto footwall = fem::make_footwall(lis1_footwall(2000.0));
    const std::vector<double> c = footwall->compliance();
    const std::size_t n = 2 * footwall->interface().size();
    ASSERT_EQ(c.size(), n * n);
    Random random(1);
    fem::Load load;
    for (std::size_t k = 0; k < n; ++k)
        load.interface.push_back(1e11 * random.between(-1.0, 1.0));
    footwall->solve(load);
    const std::vector<double> u = times(c, load.interface);
    const double same_factors = difference(u, footwall->interface_displacement());
    // Another footwall's factors know nothing of the interface.
    const auto other = fem::make_footwall(lis1_footwall(2000.0));
    other->solve(load);
    std::vector<double> recovered, full;
    for (const auto& [from, to] : {std::pair(&footwall, &recovered), std::pair(&other, &full)}) {
        const fem::Field field = (*from)->field();
        for (const Vector& place : field.displacement)
            to->insert(to->end(), {place.x, place.y});
    }
    const double other_factors = difference(u, other->interface_displacement());
    const double everywhere = difference(recovered, full);
    std::printf("%zu interface unknowns of %zu: condensed and full %.1e, with other factors %.1e, "
                "all unknowns %.1e\n",
                n, footwall->mesh().unknowns, same_factors, other_factors, everywhere);
    EXPECT_LT(same_factors, 1e-12);
    // Accuracy of a solution from factors: round-off of the stiffness, 1e-16 of the elements'
    // 1e11, against springs of 1e7 that alone resist a vertical motion.
    EXPECT_LT(other_factors, 1e-11);
    EXPECT_LT(everywhere, 1e-11);
}

TEST(Compliance, IsTheSameTwice) {
    std::vector<double> first;
    for (int k = 0; k < 2; ++k) {
        const auto footwall = fem::make_footwall(lis1_footwall(2000.0));
        if (k == 1) // what was solved before makes no difference
            footwall->solve({});
        const std::vector<double> c = footwall->compliance();
        if (k == 0)
            first = c;
        EXPECT_EQ(c, first);
        EXPECT_EQ(footwall->compliance(), first);
    }
}

TEST(Compliance, IsSymmetricAndPositiveDefinite) {
    const auto footwall = fem::make_footwall(lis1_footwall(2000.0));
    std::vector<double> c = footwall->compliance();
    const std::size_t n = 2 * footwall->interface().size();
    double asymmetry = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            asymmetry = std::max(asymmetry, std::abs(c[i * n + j] - c[j * n + i]));
            largest = std::max(largest, std::abs(c[i * n + j]));
        }
    EXPECT_LT(asymmetry, 1e-12 * largest); // round-off of the factors
    // Cholesky: every pivot positive, none lost to round-off.
    for (std::size_t k = 0; k < n; ++k) {
        ASSERT_GT(c[k * n + k], 1e-8 * largest) << "pivot " << k;
        const double pivot = std::sqrt(c[k * n + k]);
        for (std::size_t i = k; i < n; ++i)
            c[i * n + k] /= pivot;
        for (std::size_t j = k + 1; j < n; ++j)
            for (std::size_t i = j; i < n; ++i)
                c[i * n + j] -= c[i * n + k] * c[j * n + k];
    }
}

TEST(Compliance, IsQuickAtTheSizeOfARun) {
    const auto footwall = fem::make_footwall(lis1_footwall(1000.0));
    const std::clock_t start = std::clock();
    const std::vector<double> c = footwall->compliance();
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const std::size_t n = footwall->interface().size();
    std::printf("%zu interface unknowns of %zu: %.2f CPU seconds; breakaway %.1f m per 1e12 N/m\n",
                2 * n, footwall->mesh().unknowns, seconds, 1e12 * c[2 * n + 1]);
    EXPECT_GT(2 * n, 250u);
    // A feasibility study found 975 m on a coarser mesh; a force at a point sinks in with the
    // logarithm of the cell size, 2 % from h to h/2.
    EXPECT_NEAR(1e12 * c[2 * n + 1], 975.0, 25.0);
}

TEST(Interface, ForcesAndMomentsArriveWhole) {
    for (const auto& chain : {listric_detachment(), ramp_flat_ramp()}) {
        fem::FootwallRequest request = lis1_footwall(2000.0);
        request.detachment = chain;
        const auto footwall = fem::make_footwall(request);
        const auto& nodes = footwall->interface();
        Random random(2);
        for (int k = 0; k < 50; ++k) {
            // Anywhere on the trace of a face: X = sum N_i X_i.
            const auto& faces = footwall->interface_faces();
            const auto& face = faces[static_cast<std::size_t>(random.between(0.0, 1.0) *
                                                              static_cast<double>(faces.size()))];
            const double t = random.between(0.0, 1.0);
            const double shape[3] = {(1 - t) * (1 - 2 * t), t * (2 * t - 1), 4 * t * (1 - t)};
            Vector p;
            for (std::size_t i = 0; i < 3; ++i) {
                p.x += shape[i] * nodes[face.nodes[i]].place.x;
                p.y += shape[i] * nodes[face.nodes[i]].place.y;
            }
            const fem::PointForce force{p, {random.between(-1.0, 1.0), random.between(-1.0, 1.0)}};
            const std::vector<double> f = footwall->nodal_forces({&force, 1});
            double x = 0.0, y = 0.0, moment = 0.0;
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                x += f[2 * i];
                y += f[2 * i + 1];
                moment += nodes[i].place.x * f[2 * i + 1] - nodes[i].place.y * f[2 * i];
            }
            EXPECT_NEAR(x, force.force.x, 1e-14); // round-off
            EXPECT_NEAR(y, force.force.y, 1e-14);
            // Round-off over an arm of up to 60 km.
            EXPECT_NEAR(moment, p.x * force.force.y - p.y * force.force.x, 1e-9);
        }
    }
}

TEST(Interface, RefusesForcesAtNoPlace) {
    const auto footwall = fem::make_footwall(lis1_footwall(4000.0));
    const fem::PointForce force{{std::nan(""), -5e3}, {1.0, 0.0}};
    EXPECT_THROW(footwall->nodal_forces({&force, 1}), fem::FootwallError);
}

TEST(Interface, NodesFollowTheDetachment) {
    const auto footwall = fem::make_footwall(lis1_footwall(2000.0));
    const auto& nodes = footwall->interface();
    EXPECT_NEAR(nodes.front().place.x, 0.0, 1e-6);
    EXPECT_NEAR(nodes.front().place.y, 0.0, 1e-6);
    EXPECT_NEAR(nodes.back().place.y, -15e3, 1e-6);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const auto [place, s] = nodes[k];
        if (k > 0) {
            EXPECT_GT(s, nodes[k - 1].arc_length);
        }
        if (place.x < 15e3) {
            EXPECT_NEAR(std::hypot(place.x - 15e3, place.y), 15e3, 1e-6);
            EXPECT_NEAR(s, 15e3 * std::atan2(-place.y, 15e3 - place.x), 1e-6);
        }
    }
}

TEST(Equilibrium, SpringsCarryTheLoad) {
    fem::FootwallRequest request = lis1_footwall(2000.0);
    request.left_side = request.right_side = fem::Side::elastic;
    const auto footwall = fem::make_footwall(request);
    const std::vector<fem::PointForce> forces = {{{2e3, -7e3}, {3e11, 8e11}},
                                                 {{30e3, -15e3}, {-1e11, 5e11}}};
    fem::Load load;
    load.interface = footwall->nodal_forces(forces);
    footwall->solve(load);
    // Round-off times the condition of the stiffness, about 1e5.
    EXPECT_NEAR(footwall->reaction().y, -1.3e12, 1e-10 * 1.3e12);
    EXPECT_NEAR(footwall->reaction().x, -2e11, 1e-9 * 1.3e12);
}

TEST(Equilibrium, NoLoadNoDisplacement) {
    const auto footwall = fem::make_footwall(lis1_footwall(4000.0));
    footwall->solve({});
    for (double u : footwall->interface_displacement())
        EXPECT_EQ(u, 0.0);
}

TEST(Solvers, MultigridAgreesWithFactors) {
    fem::FootwallRequest request = small_footwall();
    request.refinements = 1;
    std::vector<std::vector<double>> found;
    for (const auto solver : {fem::Solver::mumps, fem::Solver::boomeramg, fem::Solver::gamg}) {
        request.solver = solver;
        const auto footwall = fem::make_footwall(request);
        const fem::PointForce force{{2e3, -7e3}, {3e11, 8e11}};
        fem::Load load;
        load.interface = footwall->nodal_forces({&force, 1});
        footwall->solve(load);
        std::printf("%d iterations, %zu unknowns\n", footwall->iterations(),
                    footwall->mesh().unknowns);
        found.push_back(footwall->interface_displacement());
        if (solver != fem::Solver::mumps) {
            EXPECT_THROW(footwall->compliance(), fem::FootwallError);
        }
    }
    for (std::size_t k = 0; k < found[0].size(); ++k) { // residual 1e-12 of the load
        EXPECT_NEAR(found[1][k], found[0][k], 1e-8 * std::abs(found[0][1]));
        EXPECT_NEAR(found[2][k], found[0][k], 1e-8 * std::abs(found[0][1]));
    }
}

} // namespace
} // namespace listric::fem_compliance_test
