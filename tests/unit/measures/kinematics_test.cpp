// Constructions on arcs whose results are known in closed form. Curves are sampled every 25 m, so
// heights are off by at most 25^2 / 8 R, centimetres, and the last column by one sample.

#include "apps/measures/basin/kinematics.hpp"
#include "dem/numbers/units.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace listric::kinematics_test {

using namespace dem;
using namespace measures;
namespace {

constexpr double degree = pi / 180.0;

/// One arc from `dip` at the breakaway to the flat at 15 km depth.
Chain arc_and_flat(double dip) {
    const double radius = 15e3 / (1.0 - std::cos(dip * degree));
    Chain chain{
        arc({0.0, 0.0}, {std::cos(dip * degree), -std::sin(dip * degree)}, radius, dip * degree)};
    const Point end = chain.back().end;
    chain.push_back(line(end, {end.x + 80e3, end.y}));
    return chain;
}

/// Two steep arcs with a flat at 7 km between them [paper, experiment III].
Chain ramp_flat_ramp() {
    Chain chain{arc({0.0, 0.0}, {0.0, -1.0}, 7e3, 90.0 * degree)};
    chain.push_back(line({7e3, -7e3}, {12e3, -7e3}));
    chain.push_back(arc({12e3, -7e3}, {0.0, -1.0}, 8e3, 90.0 * degree));
    chain.push_back(line({20e3, -15e3}, {100e3, -15e3}));
    return chain;
}

double area_above(const std::vector<Point>& top) {
    double area = 0.0;
    for (std::size_t k = 0; k + 1 < top.size(); ++k)
        area -= 0.5 * (top[k].y + top[k + 1].y) * (top[k + 1].x - top[k].x);
    return area;
}

/// Area between the original surface and the detachment from the breakaway to x.
double area_above_detachment(const Chain& chain, double x) {
    std::vector<Point> points{{0.0, 0.0}};
    for (double s = 0.0; points.back().x < x; s += 1.0)
        points.push_back(point_at(chain, s));
    return area_above(points);
}

TEST(InclinedShear, CutoffOnAnArc) {
    // x + z tan(angle) = e on x = R (sin d0 - sin t), z = R (cos t - cos d0); solved by hand:
    // the table of the measures' source has (4.1, 10.3), (2.2, 7.8), (5.8, 7.2), (4.3, 5.7) km.
    const struct {
        double dip, angle, x, z;
    } table[] = {{90.0, 30.0, 4.1e3, 10.3e3},
                 {90.0, 45.0, 2.2e3, 7.8e3},
                 {60.0, 30.0, 5.8e3, 7.2e3},
                 {60.0, 45.0, 4.3e3, 5.7e3}};
    for (const auto& row : table) {
        const std::vector<Point> top =
            inclined_shear_top(arc_and_flat(row.dip), 10e3, row.angle, 50e3);
        EXPECT_NEAR(top.front().x, row.x, 60.0) << row.dip << " " << row.angle;
        EXPECT_NEAR(-top.front().y, row.z, 60.0) << row.dip << " " << row.angle;
        EXPECT_NEAR(top.front().x - top.front().y * std::tan(row.angle * degree), 10e3, 1.0);
    }
}

TEST(InclinedShear, ConservesArea) {
    for (const Chain& chain : {arc_and_flat(90.0), arc_and_flat(60.0), ramp_flat_ramp()})
        for (double angle : {0.0, 30.0, 45.0}) {
            const std::vector<Point> top = inclined_shear_top(chain, 10e3, angle, 80e3);
            const double area = area_above(top) + area_above_detachment(chain, top.front().x);
            // One sample at the cutoff, 25 m by 15 km at most.
            EXPECT_NEAR(area, 10e3 * 15e3, 4e5) << angle;
        }
}

TEST(InclinedShear, FitFindsTheAngle) {
    const Chain chain = arc_and_flat(60.0);
    for (double angle : {-10.0, 20.0, 37.5}) {
        const std::vector<Point> truth = inclined_shear_top(chain, 5e3, angle, 60e3);
        std::vector<double> x, top;
        std::size_t k = 0;
        for (double column = 93.0; column < 45e3; column += 186.0) {
            double y;
            if (column < truth.front().x) {
                double s = 0.0;
                while (point_at(chain, s).x < column)
                    s += 1.0;
                y = point_at(chain, s).y;
            } else {
                while (truth[k + 1].x < column)
                    ++k;
                const double share = (column - truth[k].x) / (truth[k + 1].x - truth[k].x);
                y = truth[k].y + share * (truth[k + 1].y - truth[k].y);
            }
            x.push_back(column);
            top.push_back(y);
        }
        const InclinedShearFit fit = fit_inclined_shear(chain, 5e3, x, top);
        EXPECT_EQ(fit.angle, angle);
        EXPECT_LT(fit.misfit, 5.0);
    }
}

TEST(NormalsStayNormal, HeadBlockOfAQuarterCircle) {
    const Chain chain = arc_and_flat(90.0);
    const double turn = 10.0 / 15.0; // e / R
    EXPECT_NEAR(normals_tilt(chain, 10e3), turn / degree, 1e-3);
    const std::vector<Point> top = normals_top(chain, 10e3, 50e3);
    // The surface between breakaway and centre turns around the centre, (15, 0) km.
    const Point cutoff{15e3 * (1.0 - std::cos(turn)), -15e3 * std::sin(turn)};
    EXPECT_NEAR(top.front().x, cutoff.x, 0.1);
    EXPECT_NEAR(top.front().y, cutoff.y, 0.1);
    for (const Point& p : top) {
        if (p.x < 14.9e3) {
            EXPECT_NEAR(p.y, (p.x - 15e3) * std::tan(turn), 1.0);
        } else if (p.x > 15.1e3) {
            EXPECT_GE(p.x, 25e3 - 1.0); // the gap is as wide as the extension
            EXPECT_NEAR(p.y, 0.0, 0.1);
        }
    }
    EXPECT_NEAR(normals_halfgraben_share(chain, 10e3, 50e3), 0.5, 0.002);
}

TEST(NormalsStayNormal, ShallowArc) {
    const Chain chain = arc_and_flat(60.0);
    EXPECT_NEAR(normals_tilt(chain, 10e3), 10.0 / 30.0 / degree, 1e-3);
    // (1 + cos d0) / 2 for small slip; samples are 25 m.
    EXPECT_NEAR(normals_halfgraben_share(chain, 500.0, 50e3), 0.75, 0.01);
    const std::vector<Point> top = normals_top(chain, 10e3, 60e3);
    // While it is on the arc, the surface turns around the centre, R cos d0 above it.
    const double turn = 10.0 / 30.0;
    const Point centre{30e3 * std::sin(60.0 * degree), 15e3};
    for (const Point& p : top) {
        if (p.x < centre.x) {
            const double x = p.x - centre.x, y = p.y - centre.y;
            EXPECT_NEAR(centre.y - std::sin(turn) * x + std::cos(turn) * y, 0.0, 0.1);
        }
        EXPECT_LE(p.y, 0.1); // on the flat, normals are upright and no longer than before
    }
}

TEST(NormalsStayNormal, AnyChain) {
    const std::vector<Point> top = normals_top(ramp_flat_ramp(), 10e3, 60e3);
    ASSERT_GT(top.size(), 100u);
    for (const Point& p : top) {
        EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
        EXPECT_GT(p.y, -15e3);
    }
    EXPECT_NEAR(normals_tilt(ramp_flat_ramp(), 10e3), 10.0 / 7.0 / degree, 0.01);
    EXPECT_NEAR(top.back().y, 0.0, 0.1);
}

TEST(Misfit, OfAShiftedCurve) {
    const Chain chain = arc_and_flat(90.0);
    std::vector<double> x, top;
    for (double column = 20e3; column < 40e3; column += 200.0) {
        x.push_back(column);
        top.push_back(-300.0);
    }
    const std::vector<Point> flat{{10e3, 0.0}, {60e3, 0.0}};
    EXPECT_NEAR(misfit(chain, flat, x, top, 50e3), 300.0, 1e-9);
    top.front() = 0.0;
    EXPECT_NEAR(misfit(chain, flat, x, top, 20.1e3), 0.0, 1e-9);
}

TEST(HeadBlock, TurnsUntilAllOfItIsWhereTheDetachmentDipsLeast) {
    // A quarter circle of 15 km, then a flat: 23.56 km.
    EXPECT_TRUE(head_block_turns(arc_and_flat(90.0), 23.5e3));
    EXPECT_FALSE(head_block_turns(arc_and_flat(90.0), 23.6e3));
    // The upper of two ramps: 11.0 km.
    EXPECT_TRUE(head_block_turns(ramp_flat_ramp(), 10.9e3));
    EXPECT_FALSE(head_block_turns(ramp_flat_ramp(), 11.1e3));
    // A plane turns nothing, at any extension.
    EXPECT_TRUE(head_block_turns({line({0.0, 0.0}, {50e3, -50e3})}, 60e3));
    // A nearly flat chain of pieces ends with the last piece that turns by half a degree.
    Chain pieces{line({0.0, 0.0}, {5e3, -5e3}), line({5e3, -5e3}, {15e3, -6e3}),
                 line({15e3, -6e3}, {60e3, -10e3})};
    EXPECT_TRUE(head_block_turns(pieces, 17e3));
    EXPECT_FALSE(head_block_turns(pieces, 18e3));
}

TEST(KinematicPrediction, SaysNothingBeyondItsConstructions) {
    const Chain chain = arc_and_flat(90.0);
    Profile profile;
    for (double x = 100.0; x < 65e3; x += 200.0) {
        profile.x.push_back(x);
        profile.pre_rift_top.push_back(std::max(-3e3, -x));
    }
    const KinematicPrediction near = predict_kinematics(chain, 10e3, profile);
    EXPECT_NEAR(near.tilt.value(), 10.0 / 15.0 / degree, 1e-4);
    EXPECT_TRUE(near.cutoff && near.normals_misfit && near.halfgraben_share);
    const KinematicPrediction far = predict_kinematics(chain, 24e3, profile);
    EXPECT_FALSE(far.tilt);
    EXPECT_FALSE(far.normals_misfit); // of a head block that has left the arc
    EXPECT_TRUE(far.cutoff);          // on the flat
    EXPECT_FALSE(predict_kinematics(chain, 110e3, profile).cutoff);
    // A top that no angle between -30 and 70 degrees fits best.
    for (double& top : profile.pre_rift_top)
        top = 0.0;
    EXPECT_FALSE(predict_kinematics(chain, 10e3, profile).shear);
}

TEST(KinematicPrediction, AShareIsNoMoreThanTheWhole) {
    Profile profile;
    for (double x = 100.0; x < 45e3; x += 200.0) {
        profile.x.push_back(x);
        profile.pre_rift_top.push_back(-100.0);
    }
    for (const double extension : {2e3, 5e3, 7e3, 10e3}) {
        const auto share =
            predict_kinematics(ramp_flat_ramp(), extension, profile).halfgraben_share;
        EXPECT_LT(share.value_or(0.0), 1.0) << extension;
    }
}

} // namespace
} // namespace listric::kinematics_test
