// Parts of the elastic footwall without finite elements: curves, blocks and refusals.

#include "fem/blocks.hpp"
#include "fem/byerlee.hpp"
#include "fem/curve.hpp"
#include "tests/message_of.hpp"
#include "tests/verification/footwalls.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <unistd.h>

namespace listric::footwall_test {

namespace {

using namespace support;
using fem::Curve;
using fem::FootwallRequest;
using fem::Vector;
using testing::HasSubstr;

constexpr double pi = std::numbers::pi;
constexpr double round_off = 1e-8; // m, of lengths around 1e5

double apart(Vector a, Vector b) { return std::hypot(a.x - b.x, a.y - b.y); }

TEST(Curve, FindsItsOwnPoints) {
    for (const auto& pieces : {listric_detachment(), ramp_flat_ramp()}) {
        const Curve curve(pieces);
        for (int k = 0; k <= 100; ++k) {
            const double s = curve.length() * k / 100;
            EXPECT_NEAR(curve.nearest(curve.at(s)), s, round_off);
            EXPECT_NEAR(curve.distance(curve.at(s)), 0.0, round_off);
        }
    }
}

TEST(Curve, OffsetIsParallel) {
    const Curve arc(listric_detachment());
    const Curve below = arc.offset(3e3);
    EXPECT_NEAR(below.length(), 18e3 * right_angle, round_off);
    for (int k = 0; k <= 10; ++k)
        EXPECT_NEAR(arc.distance(below.at(below.length() * k / 10)), 3e3, round_off);
}

TEST(Curve, OffsetOfATightBendIsACorner) {
    // The rounded end of the flat has a radius of 300 m: 3 km below, two pieces meet in a corner.
    const Curve curve(ramp_flat_ramp());
    const Curve below = curve.offset(3e3);
    EXPECT_EQ(below.pieces().size(), 3u);
    for (std::size_t k = 0; k + 1 < below.pieces().size(); ++k) {
        const auto& piece = below.pieces()[k];
        EXPECT_LT(apart(point_at(piece, piece.length), below.pieces()[k + 1].start), 1e-6);
    }
    for (int k = 0; k <= 100; ++k)
        EXPECT_GT(curve.distance(below.at(below.length() * k / 100)), 3e3 - 1e-6);
}

TEST(Curve, TurnsWhereItIsAsSteepAsFlat) {
    EXPECT_EQ(Curve(ramp_flat_ramp()).turns().size(), 3u);
    const auto turns = Curve(listric_detachment()).turns();
    ASSERT_EQ(turns.size(), 1u);
    EXPECT_NEAR(turns[0], 15e3 * pi / 4, round_off);
}

class Blocks : public testing::TestWithParam<int> {
protected:
    static FootwallRequest request() {
        FootwallRequest request;
        request.elastic_thickness = 10e3;
        request.skin_thickness = 3e3;
        request.surface_spring = 1.0;
        switch (GetParam()) {
        case 0:
            request.detachment = listric_detachment();
            break;
        case 1:
            request.detachment = detachment(pi / 3, {{30e3, pi / 3}});
            break;
        case 2:
            request.detachment = detachment(pi / 6, {{60e3, pi / 6}});
            break;
        case 3:
            request.detachment = ramp_flat_ramp();
            break;
        case 4: // kinks instead of arcs
            request.detachment = {{{0, 0}, -pi / 3, 10e3, 0},
                                  {{5e3, -10e3 * std::sin(pi / 3)}, 0, 20e3, 0}};
            break;
        default: // no detachment
            request.surface_breaks = {-20e3, 0.0, 30e3};
        }
        return request;
    }
};

TEST_P(Blocks, FillTheFootwall) {
    const FootwallRequest r = request();
    fem::check(r);
    const fem::BlockMesh mesh = fem::make_blocks(r);
    // Every edge belongs to two cells or to the boundary, and no cell is folded.
    std::map<std::pair<unsigned, unsigned>, int> cells_at;
    double area = 0.0;
    for (const auto& [v] : mesh.cells) {
        const unsigned around[4] = {v[0], v[1], v[3], v[2]};
        for (int k = 0; k < 4; ++k) {
            const unsigned a = around[k], b = around[(k + 1) % 4], c = around[(k + 3) % 4];
            ++cells_at[std::minmax(a, b)];
            const Vector &p = mesh.vertices[a], &q = mesh.vertices[b], &o = mesh.vertices[c];
            EXPECT_GT((q.x - p.x) * (o.y - p.y) - (q.y - p.y) * (o.x - p.x), 0.0)
                << "at " << p.x << ", " << p.y;
            area += 0.5 * (p.x * q.y - q.x * p.y);
        }
    }
    std::set<std::pair<unsigned, unsigned>> boundary;
    for (const auto& edge : mesh.edges)
        if (edge.boundary)
            boundary.insert(std::minmax(edge.start, edge.end));
    for (const auto& [edge, cells] : cells_at)
        EXPECT_EQ(cells, boundary.contains(edge) ? 1 : 2)
            << "at " << mesh.vertices[edge.first].x << ", " << mesh.vertices[edge.first].y;
    // Chords of arcs make the rest.
    double expected = (r.right - r.left) * r.depth;
    if (!r.detachment.empty()) {
        const Curve chain = fem::extended_detachment(r);
        const int parts = 100000;
        for (int k = 0; k < parts; ++k) {
            const Vector a = chain.at(chain.length() * k / parts);
            const Vector b = chain.at(chain.length() * (k + 1) / parts);
            expected += 0.5 * (a.y + b.y) * (b.x - a.x);
        }
    }
    EXPECT_NEAR(area / expected, 1.0, 1e-3);
}

TEST_P(Blocks, MeetAtTheElasticThickness) {
    const FootwallRequest r = request();
    const fem::BlockMesh mesh = fem::make_blocks(r);
    // Away from the detachment no cell has rock of both sides.
    for (const auto& [v] : mesh.cells) {
        double low = 0.0, high = -1e9, x = 0.0;
        for (unsigned k : v) {
            low = std::min(low, mesh.vertices[k].y);
            high = std::max(high, mesh.vertices[k].y);
            x = std::max(x, mesh.vertices[k].x);
        }
        if (x < -20e3 && r.detachment.size() != 2) { // (the kinked one is shallower than that)
            EXPECT_FALSE(high > -10e3 + 1.0 && low < -10e3 - 1.0) << low << " to " << high;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Footwall, Blocks, testing::Range(0, 6));

/// Message of check().
std::string refusal(const std::function<void(FootwallRequest&)>& spoil) {
    FootwallRequest request = small_footwall();
    spoil(request);
    return support::message_of<fem::FootwallError>([&] { fem::check(request); }, "");
}

TEST(FootwallCheck, NamesWhatIsWrong) {
    EXPECT_EQ(refusal([](FootwallRequest&) {}), "");
    EXPECT_THAT(refusal([](auto& r) { r.layers[0].poisson_ratio = 0.5; }),
                HasSubstr("layer 1: Poisson's ratio 0.5, allowed: above -1, below 0.5"));
    EXPECT_THAT(refusal([](auto& r) { r.layers[0].viscosity = -1e21; }),
                HasSubstr("layer 1: viscosity -1e+21 Pa s, allowed: above 0"));
    EXPECT_THAT(refusal([](auto& r) { r.layers[0].young_modulus = -1e9; }),
                HasSubstr("layer 1: Young's modulus -1e+09 Pa, allowed: above 0"));
    EXPECT_THAT(refusal([](auto& r) {
                    r.layers = {{0}, {20e3}, {10e3}};
                }),
                HasSubstr("layer 3 overlaps the one before"));
    EXPECT_THAT(refusal([](auto& r) {
                    r.layers = {{0}, {50e3}};
                }),
                HasSubstr("layer 2 begins at a depth of 50000 m, allowed: above the base"));
    EXPECT_THAT(refusal([](auto& r) { r.depth = 12e3; }),
                HasSubstr("the detachment leaves the mesh: it reaches a depth of 15000 m"));
    EXPECT_THAT(refusal([](auto& r) { r.right = 10e3; }),
                HasSubstr("the detachment leaves the mesh: it ends at x = 15000 m"));
    EXPECT_THAT(refusal([](auto& r) { r.left = 1e3; }),
                HasSubstr("the detachment leaves the mesh: it must begin"));
    EXPECT_THAT(refusal([](auto& r) { r.detachment[0].length *= 0.5; }),
                HasSubstr("ends inside the mesh with a dip"));
    EXPECT_THAT(refusal([](auto& r) { r.detachment[0].direction = -2.0; }), HasSubstr("overhangs"));
    EXPECT_THAT(
        refusal([](auto& r) { r.surface_spring = r.detachment_spring = r.base_spring = 0; }),
        HasSubstr("nothing holds the footwall"));
    EXPECT_THAT(refusal([](auto& r) { r.degree = 3; }), HasSubstr("degree 3, allowed: 1 and 2"));
    EXPECT_THAT(refusal([](auto& r) { r.cell_size = 0; }), HasSubstr("cell size"));
}

TEST(FootwallCheck, MissingPlugInSaysWhatToInstall) {
    setenv("LISTRIC_FEM_PLUGIN", "/no/such/plug-in.so", 1);
    try {
        fem::make_footwall(small_footwall());
        ADD_FAILURE() << "made a footwall without the plug-in";
    } catch (const fem::FootwallError& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("install libdeal.ii-dev petsc-dev libopenmpi-dev openmpi-bin gmsh"));
    }
    unsetenv("LISTRIC_FEM_PLUGIN");
}

TEST(Byerlee, CirclesThatTouchTheLawAreItsStrengths) {
    for (double confining : {1e6, 50e6, 150e6, 300e6, 1e9}) {
        const double axial = fem::byerlee_axial(confining);
        const double centre = 0.5 * (axial + confining), radius = 0.5 * (axial - confining);
        EXPECT_FALSE(fem::beyond_byerlee(centre, radius * (1.0 - 1e-9))) << confining;
        EXPECT_TRUE(fem::beyond_byerlee(centre, radius * (1.0 + 1e-9))) << confining;
    }
}

TEST(FootwallSeries, IsReplacedWhole) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("series-" + std::to_string(getpid()));
    fs::create_directory(folder);
    const fs::path pvd = folder / "footwall.pvd";
    std::ofstream(pvd) << "what was there before";
    const std::pair<double, std::string> moments[] = {{0.5, "a.vtu"}, {1.0, "b.vtu"}};
    fem::write_series(pvd.string(), moments);
    std::ifstream file(pvd);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    EXPECT_THAT(text, HasSubstr("<DataSet timestep=\"0.5\" part=\"0\" name=\"footwall\" "
                                "file=\"a.vtu\"/>\n"));
    EXPECT_THAT(text, testing::EndsWith("</Collection>\n</VTKFile>\n"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "nothing else stays";
    fs::remove_all(folder);
    EXPECT_THROW(fem::write_series(pvd.string(), moments), fem::WriteError);
}

} // namespace
} // namespace listric::footwall_test
