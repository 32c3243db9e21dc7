// AFD's measure circle finds known displacements, on packings that genesis settled
// (disc sizes of draft, standard = the paper's, and fine).
//
// The displacement gradient from two cuts through a circle is exact for any homogeneous strain,
// whatever the discs, so a rotation reads its round-off and simple shear its rate but for the
// direction: planes are tried every 15 degrees, and cos(2 * 7.5 degrees) = 0.966. The rates of 1.05
// and 0.95 times 1e-13 per second stand for 65.5 and 59.2 m in the paper's circle, the least slip
// of 62 m is between them.
//
// A cut between rigid sides is not homogeneous: with some ten discs on a side the halves' centroids
// lie up to a fifth nearer or farther than those of half discs. A slip of 80 m (1.29 times the
// least) shall be found and one of 45 m (0.73) not. Across a band of simple shear of three
// diameters the halves of a circle of five see 0.63 of its slip: 120 m are 75 m, 80 m are 50 m.

#include "dem/contacts/cells.hpp"
#include "dem/contacts/soft_discs.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/measure_circle.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>

namespace listric::fault_detection_test {

using namespace dem;
namespace {

using namespace support;

constexpr double rate = 0.01, window = 5e4 * seconds_per_year;
constexpr int directions = 36;

using Field = std::function<Point(Point)>; ///< displacement at a place from the middle, m

/// 43 x 32 mean diameters of bonded discs, made once.
const State& packing(double mean_radius) {
    static std::map<double, State> made;
    const auto known = made.find(mean_radius);
    if (known != made.end())
        return known->second;
    GenesisRequest request = packing_request(86.0 * mean_radius, 64.0 * mean_radius, mean_radius);
    request.bonds = BondStrength{};
    return made.emplace(mean_radius, settled(request)).first->second;
}

/// A packing between two scans.
struct Slab {
    State state;
    FaultWeakening event;
    Point low, high; ///< corners

    Slab(const FaultWeakeningParameters& p, const Field& displacement, double mean_radius = 93.1)
        : state(packing(mean_radius)), event(p, rate, 9.81) {
        event.begin(state);
        const DiscColumns d = disc_columns(state);
        const auto [left, right] = std::ranges::minmax(d.x);
        const auto [bottom, top] = std::ranges::minmax(d.y);
        low = {left, bottom};
        high = {right, top};
        const Point middle = 0.5 * (low + high);
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const Point u = displacement(Point{d.x[i], d.y[i]} - middle);
            d.x[i] += u.x;
            d.y[i] += u.y;
        }
    }

    std::size_t found() {
        event.apply(state, {});
        return event.memory.rows();
    }
    std::ptrdiff_t weak_discs() { return std::ranges::count(disc_columns(state).material, weak); }

    /// Whether a circle is wholly in the packing, also after a side has slid by 100 m.
    bool inside(Point centre) const {
        const double reach = 5.0 * state.mean_radius + 100.0;
        return centre.x > low.x + reach && centre.x < high.x - reach && centre.y > low.y + reach &&
               centre.y < high.y - reach;
    }

    /// Largest slip in circles wholly inside, at points half a radius apart, m.
    double largest_slip() {
        const ConstDiscColumns d = disc_columns(std::as_const(state));
        const auto scanned_x = state.discs.get<double>("scanned_x");
        const auto scanned_y = state.discs.get<double>("scanned_y");
        Displacements s;
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            s.row.push_back(static_cast<std::int32_t>(i));
            s.x.push_back(d.x[i]);
            s.y.push_back(d.y[i]);
            s.ux.push_back(d.x[i] - scanned_x[i]);
            s.uy.push_back(d.y[i] - scanned_y[i]);
        }
        const double circle = 10.0 * state.mean_radius, step = 0.5 * state.mean_radius;
        const Cells cells(s.x, s.y, 0.5 * circle);
        double largest = 0.0;
        std::vector<std::int32_t> members;
        for (double x = low.x + 0.5 * circle; x < high.x - 0.5 * circle; x += step)
            for (double y = low.y + 0.5 * circle; y < high.y - 0.5 * circle; y += step) {
                members.clear();
                cells.for_each_near(x, y, [&](std::int32_t k) {
                    const auto i = static_cast<std::size_t>(k);
                    if (std::hypot(s.x[i] - x, s.y[i] - y) <= 0.5 * circle)
                        members.push_back(k);
                });
                const double slip = std::abs(
                    most_active_plane(s, members, {x, y}, circle, plane_directions(12)).slip);
                EXPECT_LE(slip, slip_bound(s, members, {x, y}) + 1e-9);
                largest = std::max(largest, slip);
            }
        return largest;
    }
};

Point direction(int k) { return {std::cos(pi * k / directions), std::sin(pi * k / directions)}; }

Field simple_shear(Point t, double strain) {
    return [=](Point at) { return strain * cross(t, at) * t; };
}

/// The left side slides along t by `slip`, the right side stays.
Field cut(Point t, double slip) {
    return [=](Point at) { return (cross(t, at) > 0.0 ? slip : 0.0) * t; };
}

Field band(Point t, double slip, double width) {
    return [=](Point at) { return slip * std::clamp(cross(t, at) / width, -0.5, 0.5) * t; };
}

Field rotation(double angle) {
    return [=](Point at) {
        return Point{(std::cos(angle) - 1.0) * at.x - std::sin(angle) * at.y,
                     std::sin(angle) * at.x + (std::cos(angle) - 1.0) * at.y};
    };
}

TEST(FaultDetection, RotationIsNoSlip) {
    FaultWeakeningParameters p;
    p.least_slip = 1e-9; // places are some 1e4 m, so their differences are exact to 2e-12 m
    for (const double angle : {5.0, -5.0, 0.5}) {
        Slab slab(p, rotation(angle * pi / 180.0));
        EXPECT_EQ(slab.found(), 0u) << angle;
        EXPECT_EQ(slab.weak_discs(), 0) << angle;
    }
}

TEST(FaultDetection, CriticalSlipIsThePapersRateInItsCircle) {
    const double diameter = 2.0 * 93.1;
    const FaultWeakeningParameters slip;
    EXPECT_EQ(critical_slip(slip, diameter), 62.0);
    EXPECT_EQ(critical_slip(slip, 2.0 * diameter), 62.0);
    EXPECT_NEAR(critical_rate(slip, diameter), 1e-13, 1e-15);
    FaultWeakeningParameters strain;
    strain.strain_rate = 1e-13;
    EXPECT_NEAR(critical_slip(strain, diameter), 62.0, 0.5);
    EXPECT_EQ(critical_rate(strain, diameter), 1e-13);
    EXPECT_DOUBLE_EQ(critical_slip(strain, 2.0 * diameter), 2.0 * critical_slip(strain, diameter));
}

TEST(FaultDetection, SimpleShearIsFoundAtItsRateInEveryDirection) {
    for (int k = 0; k < directions; ++k) {
        EXPECT_GT(Slab({}, simple_shear(direction(k), 1.05e-13 * window)).found(), 0u) << k;
        EXPECT_EQ(Slab({}, simple_shear(direction(k), 0.95e-13 * window)).found(), 0u) << k;
    }
}

TEST(FaultDetection, RotationTakesNothingFromShear) {
    const auto turned_shear = [](double rate_per_s) {
        return [=](Point at) {
            const Point sheared = simple_shear(direction(0), rate_per_s * window)(at);
            return sheared + rotation(2.0 * pi / 180.0)(at + sheared);
        };
    };
    EXPECT_GT(Slab({}, turned_shear(1.05e-13)).found(), 0u);
    EXPECT_EQ(Slab({}, turned_shear(0.95e-13)).found(), 0u);
}

TEST(FaultDetection, ABandOfThreeDiametersIsFoundBySlipOnItsWholeWidth) {
    const double width = 6.0 * 93.1;
    for (int k = 0; k < directions; ++k) {
        EXPECT_GT(Slab({}, band(direction(k), 120.0, width)).found(), 0u) << k;
        EXPECT_EQ(Slab({}, band(direction(k), 80.0, width)).found(), 0u) << k;
    }
}

TEST(FaultDetection, ACutBetweenRigidSidesIsAFaultByItsSlipAtEveryDiscSize) {
    for (const double radius : {186.2, 93.1, 46.55})
        for (int k = 0; k < directions; k += 3) {
            Slab active({}, cut(direction(k), 80.0), radius);
            EXPECT_GT(active.largest_slip(), 62.0) << radius << " " << k;
            EXPECT_GT(active.found(), 0u) << radius << " " << k;
            EXPECT_LT(Slab({}, cut(direction(k), 45.0), radius).largest_slip(), 62.0)
                << radius << " " << k;
        }
}

/// A strain is that of two planes: the fault is along the cut, not across it.
TEST(FaultDetection, TheFaultIsAlongTheCut) {
    for (int k = 0; k < directions; ++k)
        for (const double slip : {80.0, -100.0}) {
            Slab slab({}, cut(direction(k), slip));
            ASSERT_GT(slab.found(), 0u);
            const auto x = slab.event.memory.get<double>("x_m");
            const auto y = slab.event.memory.get<double>("y_m");
            const auto a = slab.event.memory.get<double>("angle_rad");
            for (std::size_t f = 0; f < x.size(); ++f)
                if (slab.inside({x[f], y[f]})) {
                    EXPECT_LT(std::abs(cross(direction(k), {std::cos(a[f]), std::sin(a[f])})), 0.5)
                        << k << " " << slip;
                }
        }
}

} // namespace
} // namespace listric::fault_detection_test
