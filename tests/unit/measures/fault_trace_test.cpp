// Shear zones drawn into a cloud of discs whose place, dip, slip and width are known.
//
// A band of width w whose shear is a Gaussian of that full width at half maximum looks
// sqrt(w^2 + 2.4^2) diameters wide: the gradient's circle (2.3) and the profile's bins (0.75) blur
// it. Places are known to half the grid's step plus the scatter of 12 discs per circle: half a
// diameter. A dip over L diameters is then off by less than atan(1 / L).

#include "apps/measures/faults/fault_history.hpp"
#include "apps/measures/faults/fault_throw.hpp"
#include "apps/measures/faults/fault_trace.hpp"
#include "apps/measures/faults/offset/fault_offset.hpp"
#include "apps/measures/strata/rock.hpp"
#include "dem/events/property_update.hpp"
#include "dem/threads/shared_loop.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace listric::fault_trace_test {

using namespace dem;
using namespace measures;
namespace {

using namespace support;

constexpr double r = 93.1, d = 2.0 * r;
constexpr double degree = pi / 180.0;
/// Full width at half maximum of a Gaussian over its standard deviation.
const double fwhm = 2.0 * std::sqrt(2.0 * std::log(2.0));

/// Displacement from place, m.
using Motion = std::function<Point(Point)>;

/// Block of 110 by 80 discs, its top at y = 0, that moved within 500 m of extension.
struct Block {
    State before, now;

    explicit Block(const Motion& motion) {
        std::vector<Disc> discs = cloud(110, 80, r, 3);
        for (Disc& disc : discs)
            disc.y -= 79.0 * std::sqrt(3.0) * r;
        before = make_state(discs);
        now = before;
        now.clock.travel.m = now.clock.extension.m = 500.0;
        const DiscColumns columns = disc_columns(now);
        for (std::size_t i = 0; i < columns.x.size(); ++i) {
            const Point u = motion({columns.x[i], columns.y[i]});
            columns.x[i] += u.x;
            columns.y[i] += u.y;
        }
    }
    std::vector<FaultTrace> trace() const {
        return trace_faults(shear_field(DiscPlaces(before), DiscPlaces(now), {}), {});
    }
};

const Point middle{110.0 * r, -40.0 * std::sqrt(3.0) * r};

/// Normal slip on a zone through a point that falls to the right (dip < 90) or left (> 90): its
/// right side moves down along it relative to the left. `width` in diameters, 0: sharp.
Motion zone(Point through, double dip, double slip, double width) {
    const Point down{std::cos(dip * degree), -std::sin(dip * degree)};
    return [=](Point p) {
        // Distance on the right, which is the left of the downward direction.
        const double s = down.x * (p.y - through.y) - down.y * (p.x - through.x);
        const double share = width > 0.0 ? 0.5 * std::erf(s * fwhm / (width * d * std::sqrt(2.0)))
                                         : (s > 0.0 ? 0.5 : -0.5);
        return Point{slip * share * down.x, slip * share * down.y};
    };
}

Motion operator+(const Motion& a, const Motion& b) {
    return [=](Point p) {
        const Point u = a(p), v = b(p);
        return Point{u.x + v.x, u.y + v.y};
    };
}

double middle_of(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

TEST(FaultTrace, StraightBand) {
    for (double dip : {60.0, 45.0, 120.0, 90.0})
        for (double width : {0.0, 3.0, 5.0}) {
            SCOPED_TRACE(testing::Message() << dip << " " << width);
            const double slip = 200.0 + 60.0 * width;
            const std::vector<FaultTrace> traces = Block(zone(middle, dip, slip, width)).trace();
            ASSERT_EQ(traces.size(), 1u);
            const FaultTrace& t = traces[0];
            // From edge to edge, but for the smoothing's and the profile's reach.
            const double whole = std::min(69.0 * d / std::sin(dip * degree),
                                          110.0 * d / std::abs(std::cos(dip * degree)));
            EXPECT_GT(t.length(), whole - 16.0 * d);
            EXPECT_NEAR(dip_of(t.points), dip > 90.0 ? 180.0 - dip : dip, 1.0);
            for (std::size_t k = 0; k < t.points.size(); ++k) {
                const Point p = t.points[k];
                const double s = std::sin(dip * degree) * (p.x - middle.x) +
                                 std::cos(dip * degree) * (p.y - middle.y);
                // Near the block's edge half of the circle is missing, and a trace bends.
                const bool end = k < 8 || k + 8 >= t.points.size();
                EXPECT_LT(std::abs(s), (end ? 2.5 : 1.0) * d);
            }
            // The profile is cut where it is a tenth of its peak.
            EXPECT_NEAR(middle_of(t.slip), slip, 0.15 * slip);
            EXPECT_NEAR(middle_of(t.width) / d, std::hypot(width, 2.4), 0.5);
            EXPECT_LT(std::abs(curvature_of(t.points)), 0.05 / (60.0 * d));
        }
}

TEST(FaultTrace, SenseIsTheSlipsSign) {
    const auto normal = Block(zone(middle, 60.0, 250.0, 3.0)).trace();
    const auto reverse = Block(zone(middle, 60.0, -250.0, 3.0)).trace();
    ASSERT_EQ(normal.size(), 1u);
    ASSERT_EQ(reverse.size(), 1u);
    EXPECT_GT(middle_of(normal[0].slip), 0.0);
    EXPECT_LT(middle_of(reverse[0].slip), 0.0);
}

TEST(FaultTrace, RotationIsNoFault) {
    EXPECT_TRUE(Block([](Point p) { return Point{-0.3 * p.y, 0.3 * p.x}; }).trace().empty());
}

TEST(FaultTrace, ConvexArc) {
    // A quarter of the way around a circle: it flattens upward, so it is convex upward.
    const double radius = 80.0 * d;
    const Point centre{middle.x + radius * std::cos(45.0 * degree),
                       middle.y - radius * std::sin(45.0 * degree)};
    const Block block([&](Point p) {
        // The inside is the footwall; the hanging wall slides down around it, to the left.
        const double x = p.x - centre.x, y = p.y - centre.y, distance = std::hypot(x, y);
        const double share =
            0.5 + 0.5 * std::erf((distance - radius) * fwhm / (3.0 * d * std::sqrt(2.0)));
        return Point{-300.0 * share * y / radius, 300.0 * share * x / radius};
    });
    const std::vector<FaultTrace> traces = block.trace();
    ASSERT_EQ(traces.size(), 1u);
    // The parabola through an arc of half angle a is more curved by up to a^2 / 4.
    const double half_angle = 0.5 * traces[0].length() / radius;
    EXPECT_GT(half_angle, 0.3);
    EXPECT_NEAR(curvature_of(traces[0].points) * radius, 1.0, 0.1 + half_angle * half_angle / 4.0);
}

TEST(FaultTrace, CrossingFaults) {
    const std::vector<FaultTrace> traces =
        Block(zone(middle, 60.0, 250.0, 3.0) + zone(middle, 120.0, -350.0, 3.0)).trace();
    ASSERT_EQ(traces.size(), 2u);
    for (const FaultTrace& t : traces) {
        EXPECT_NEAR(dip_of(t.points), 60.0, 2.0);
        EXPECT_GT(t.length(), 60.0 * d);
    }
    const auto falls_right = [](const FaultTrace& t) {
        return t.points.back().x > t.points.front().x;
    };
    EXPECT_NE(falls_right(traces[0]), falls_right(traces[1]));
    EXPECT_NEAR(std::abs(middle_of(traces[falls_right(traces[0]) ? 0 : 1].slip)), 250.0, 40.0);
    EXPECT_NEAR(std::abs(middle_of(traces[falls_right(traces[0]) ? 1 : 0].slip)), 350.0, 40.0);
}

TEST(FaultTrace, ThreadsDoNotMatter) {
    const Block block(zone(middle, 60.0, 250.0, 3.0) + zone(middle, 120.0, -350.0, 3.0));
    const std::vector<FaultTrace> alone = block.trace();
    ASSERT_EQ(alone.size(), 2u);
    for (const int threads : {2, 3, 8}) {
        const Team team(threads);
        const std::vector<FaultTrace> shared = block.trace();
        ASSERT_EQ(shared.size(), alone.size());
        for (std::size_t k = 0; k < alone.size(); ++k) {
            EXPECT_EQ(shared[k].points, alone[k].points);
            EXPECT_EQ(shared[k].slip, alone[k].slip);
            EXPECT_EQ(shared[k].width, alone[k].width);
        }
    }
}

TEST(FaultTrace, ParallelFaultsStayApart) {
    const Point right{middle.x + 10.0 * d, middle.y};
    EXPECT_EQ(Block(zone(middle, 60.0, 250.0, 2.0) + zone(right, 60.0, 200.0, 2.0)).trace().size(),
              2u);
}

TEST(FaultTrace, DiffuseShearIsNoLine) {
    EXPECT_TRUE(Block(zone(middle, 60.0, 1500.0, 14.0)).trace().empty());
    EXPECT_TRUE(Block(zone(middle, 60.0, 3000.0, 40.0)).trace().empty());
    // Strong scatter on top of even strain: crests, but none that stands out.
    Random random(5);
    EXPECT_TRUE(
        Block([&](Point p) {
            return Point{-0.1 * p.y + random.between(-15.0, 15.0), random.between(-15.0, 15.0)};
        })
            .trace()
            .empty());
}

TEST(FaultTrace, WeakSlipIsNotTraced) {
    EXPECT_TRUE(Block(zone(middle, 60.0, 40.0, 3.0)).trace().empty());
    EXPECT_TRUE(Block([](Point) { return Point{0.0, 0.0}; }).trace().empty());
}

TEST(FaultTrace, ZonesOnTheDetachmentAreLeftOut) {
    const Block block(zone(middle, 1e-3, 250.0, 3.0));
    const ShearField field = shear_field(DiscPlaces(block.before), DiscPlaces(block.now), {});
    EXPECT_EQ(trace_faults(field, {}).size(), 1u);
    const Chain under{line({-1e5, middle.y - d}, {1e5, middle.y - d})};
    EXPECT_TRUE(trace_faults(field, under).empty());
}

TEST(PolylinePlace, SideAndEnds) {
    const std::vector<Point> points{{0.0, 0.0}, {0.0, -10.0}, {5.0, -10.0}};
    const PolylinePlace right = place_on(points, {-2.0, -4.0}); // of the downward direction
    EXPECT_DOUBLE_EQ(right.distance, -2.0);
    EXPECT_FALSE(right.beyond);
    EXPECT_DOUBLE_EQ(place_on(points, {3.0, -9.0}).distance, 1.0);
    EXPECT_TRUE(place_on(points, {1.0, 2.0}).beyond);
    EXPECT_TRUE(place_on(points, {7.0, -10.0}).beyond);
}

TEST(Curvature, ParabolaAndSign) {
    std::vector<Point> points;
    for (int k = 0; k <= 20; ++k)
        points.push_back({100.0 * k, -5e-5 * (100.0 * k - 1000.0) * (100.0 * k - 1000.0)});
    EXPECT_NEAR(curvature_of(points), 1e-4, 1e-12);
    std::ranges::reverse(points);
    EXPECT_NEAR(curvature_of(points), 1e-4, 1e-12);
    for (Point& p : points)
        p.y = -p.y;
    EXPECT_NEAR(curvature_of(points), -1e-4, 1e-12);
}

/// Strata 1 (oldest) to 4, each 4 diameters thick, and the rest of a fifth, over basement; offset
/// along a fault that falls right by 60 degrees, by 500 m less 100 m per stratum, up to its top.
struct Growth {
    State state;
    std::vector<Point> fault;

    Growth() {
        std::vector<Disc> discs = cloud(110, 80, r, 4);
        state = make_state(discs);
        const DiscColumns c = disc_columns(state);
        const double base = 100.0 * r;
        for (std::size_t i = 0; i < c.x.size(); ++i) {
            const auto number = static_cast<std::int32_t>((c.y[i] - base) / (4.0 * d) + 1.0);
            c.stratum[i] = c.y[i] < base ? 0 : number;
            c.start_y[i] = c.y[i] - base;
            const double x = middle.x + (base - c.y[i]) / std::tan(60.0 * degree);
            // The whole section is tilted by 0.1; throw is measured across the fault all the same.
            const double layers = std::max(0.0, (c.y[i] - base) / (4.0 * d));
            if (c.x[i] > x)
                c.y[i] -= std::max(0.0, 500.0 - 100.0 * layers);
            c.y[i] += 0.1 * c.x[i];
        }
        for (int k = 0; k < 20; ++k)
            fault.push_back({middle.x - 5.0 * d + d * k * 0.5,
                             base + 0.1 * middle.x + 8.0 * d - d * k * 0.866});
    }
};

TEST(FaultThrow, FallsWithYoungerAge) {
    const Growth growth;
    const std::map<int, double> throws =
        throws_of(fault_cutoffs(growth.state, {.trace = growth.fault}));
    // A top is known to a tenth of a diameter, and the tilt of three tops brings 0.2 to where the
    // fault is, on both sides.
    for (int stratum = 1; stratum <= 4; ++stratum) {
        ASSERT_TRUE(throws.contains(stratum)) << stratum;
        EXPECT_NEAR(throws.at(stratum), 500.0 - 100.0 * stratum, 0.5 * d) << stratum;
    }
    EXPECT_NEAR(throws.at(0), 500.0, 0.5 * d);
    // This fault, seen as falling left, would be reverse.
    std::vector<Point> left = growth.fault;
    for (Point& p : left)
        p.x = 2.0 * middle.x - p.x;
    for (const auto& [stratum, value] : throws_of(fault_cutoffs(growth.state, {.trace = left})))
        EXPECT_LT(value, 200.0) << stratum;
}

TEST(FaultThrow, OnlyOfStrataYoungerThanTheFaultAndOfItsFirstSurface) {
    Growth growth;
    const DiscColumns c = disc_columns(growth.state);
    for (std::size_t i = 0; i < c.x.size(); ++i)
        c.start_travel[i] = 500.0 * c.stratum[i];
    const auto strata = [&](double born_at) {
        std::vector<int> numbers;
        for (const auto& [stratum, value] : growth_throws_of(
                 fault_cutoffs(growth.state, {.trace = growth.fault, .born_at = Travel(born_at)})))
            if (stratum <= 4)
                numbers.push_back(stratum);
        return numbers;
    };
    EXPECT_EQ(strata(500.0), (std::vector<int>{0, 1, 2, 3, 4}));
    EXPECT_EQ(strata(1500.0), (std::vector<int>{2, 3, 4}));
    EXPECT_EQ(strata(1500.5), (std::vector<int>{2, 3, 4})); // the window ends in the same cycle
    EXPECT_TRUE(strata(1e4).empty());                       // the fifth was the surface
}

TEST(FaultThrow, NoneOfStrataThinnerThanThreeDiscs) {
    Growth growth;
    const DiscColumns c = disc_columns(growth.state);
    for (std::size_t i = 0; i < c.x.size(); ++i)
        if (c.stratum[i] > 0) // the older half of each keeps its number, the younger gets its own
            c.stratum[i] =
                2 * c.stratum[i] - (c.start_y[i] < 4.0 * d * c.stratum[i] - 2.0 * d ? 1 : 0);
    const auto throws = throws_of(fault_cutoffs(growth.state, {.trace = growth.fault}));
    EXPECT_TRUE(throws.contains(0));
    EXPECT_EQ(throws.rbegin()->first, 0);
}

/// A fault whose right side is the footwall (it falls left) and slides every window, while the
/// footwall moves right with the wall and turns.
struct Story {
    std::vector<DiscPlaces> places;
    State now;
    Setting setting;
    RigidBase base;

    /// @param turn   of the footwall per window, degrees, counter-clockwise
    /// @param rests  window in which it does not slide
    Story(int windows, int birth, double turn, int rests = 0) {
        setting.calendar = 0.01;
        setting.youngest_sediment = Travel(2e3);
        base.surfaces = {{"detachment", {line({0.0, -1e5}, {3e5, -1e5})}, 0.0}};
        now = Block([](Point) { return Point{}; }).now;
        now.clock.travel.m = now.clock.extension.m = 0.0;
        places.emplace_back(now);
        Point pivot = middle;
        double dip = 60.0;
        for (int window = 1; window <= windows; ++window) {
            const DiscColumns c = disc_columns(now);
            const Point up{std::cos(dip * degree), std::sin(dip * degree)};
            for (std::size_t i = 0; i < c.x.size(); ++i) {
                const double s = up.y * (c.x[i] - pivot.x) - up.x * (c.y[i] - pivot.y);
                const double slip =
                    window >= birth && window != rests
                        ? -250.0 * (0.5 - 0.5 * std::erf(s * fwhm / (3.0 * d * std::sqrt(2.0))))
                        : 0.0;
                const double x = c.x[i] + slip * up.x - pivot.x;
                const double y = c.y[i] + slip * up.y - pivot.y;
                const double a = turn * degree;
                c.x[i] = pivot.x + 500.0 + std::cos(a) * x - std::sin(a) * y;
                c.y[i] = pivot.y + std::sin(a) * x + std::cos(a) * y;
            }
            pivot.x += 500.0;
            dip += turn;
            now.clock.travel.m = now.clock.extension.m = 500.0 * window;
            if (window < windows)
                places.emplace_back(now);
        }
    }
    FaultReport report() const { return report_faults(setting, base, now, places); }
};

TEST(FaultHistory, TranslatedWithoutRotation) {
    const FaultReport report = Story(6, 3, 0.0).report();
    ASSERT_EQ(report.faults.size(), 1u);
    const Fault& f = report.faults[0];
    EXPECT_TRUE(f.normal);
    EXPECT_FALSE(f.synthetic);
    EXPECT_EQ(f.born_at.m, 1500.0); // the end of the third window
    EXPECT_NEAR(f.dip, 60.0, 1.0);
    EXPECT_NEAR(f.dip_at_birth, 60.0, 2.0);
    EXPECT_NEAR(f.footwall_turn, 0.0, 0.5);
    EXPECT_NEAR(f.rate, 250.0 / 5e4 * 1e3, 0.5); // mm/a
    EXPECT_NEAR(f.width, std::hypot(3.0, 2.4), 0.5);
    ASSERT_TRUE(report.antithetic_foot.has_value());
    // The foot of the line traced at birth, three windows ago. Here it is the line's end, which is
    // known to four diameters along it.
    EXPECT_EQ(f.traced_since.m, 1500.0);
    EXPECT_NEAR(*report.antithetic_foot, f.foot.x - 1500.0, 2.0 * d);
    EXPECT_NEAR(*report.antithetic_foot, f.foot_at_birth.x, 1e-6);
    EXPECT_NEAR(f.foot.x, f.trace.points.back().x, d); // the detachment is far below
    EXPECT_FALSE(report.main_synthetic.has_value());
}

TEST(FaultHistory, RotatedWithItsFootwall) {
    const FaultReport report = Story(6, 1, 2.0).report();
    ASSERT_EQ(report.faults.size(), 1u);
    const Fault& f = report.faults[0];
    EXPECT_EQ(f.born_at.m, 500.0);
    EXPECT_NEAR(f.dip, 60.0 + 12.0, 1.5);
    // The trace is at the end of the first window at the earliest: five windows of turning.
    EXPECT_NEAR(f.footwall_turn, 10.0, 1.0);
    EXPECT_NEAR(f.dip_at_birth, 62.0, 2.5);
}

// As it slips on, turns, and rests for a window, a fault keeps its name.
TEST(FaultHistory, NameStays) {
    for (int windows = 3; windows <= 8; ++windows) {
        const FaultReport report = Story(windows, 3, 2.0, 6).report();
        if (windows == 6)
            continue; // no fault
        ASSERT_EQ(report.faults.size(), 1u) << windows;
        EXPECT_EQ(report.faults[0].name, (TraceName{Travel(1500.0), 0})) << windows;
    }
}

TEST(FaultHistory, NothingBeforeTheFirstWindow) {
    const Story story(1, 1, 0.0);
    EXPECT_TRUE(report_faults(story.setting, story.base, story.now, std::span<const DiscPlaces>())
                    .faults.empty());
}

// The fault slides by 250 m in its last three windows but one and rests in the last: its offset is
// all of the slip, where it is now. The zone is three diameters wide.
TEST(OffsetFaults, OfRestingOnesStayWithAllTheirSlip) {
    const Story story(6, 3, 0.0, 6);
    EXPECT_TRUE(story.report().faults.empty());
    const auto faults = offset_faults(story.setting, story.now, story.places.back(), 100.0);
    ASSERT_GE(faults.size(), 1u);
    const OffsetFault& fault = *std::ranges::max_element(
        faults, {}, [](const OffsetFault& f) { return length_of(f.points); });
    EXPECT_FALSE(fault.is_active);
    const double slip = 3.0 * 250.0 * std::sin(60.0 * degree);
    // The outermost bands begin three diameters away, where 2 % of the slip is still to come. With
    // tilts of the zone itself it was a quarter.
    EXPECT_NEAR(fault.offset[fault.points.size() / 2], slip, 0.05 * slip);
    EXPECT_NEAR(dip_of(fault.points), 60.0, 3.0);
    // It passes where the footwall has gone: 500 m a window from the middle.
    EXPECT_LT(std::abs(place_on(fault.points, {middle.x + 6.0 * 500.0, middle.y}).distance),
              1.5 * d);
}

TEST(OffsetFaults, OneThatSlipsInTheLastWindowIsActive) {
    const Story story(6, 1, 2.0);
    const auto faults = offset_faults(story.setting, story.now, story.places.back(), 100.0);
    ASSERT_GE(faults.size(), 1u);
    EXPECT_TRUE(faults.front().is_active);
}

/// Rock that has come up by `rise` of its place.
std::vector<OffsetFault> faults_of_rise(const std::function<double(Point)>& rise) {
    Story story(1, 9, 0.0);
    const DiscColumns c = disc_columns(story.now);
    for (std::size_t i = 0; i < c.x.size(); ++i)
        c.start_y[i] = c.y[i] - rise({c.x[i], c.y[i]});
    return offset_faults(story.setting, story.now, story.places.back(), 100.0);
}

// Both flanks of a graben of four diameters, and neither a tilted block nor a wide bend.
TEST(OffsetFaults, FlanksOfANarrowGrabenAreTwo) {
    const double left = middle.x - 2.0 * d, right = middle.x + 2.0 * d;
    const auto faults = faults_of_rise(
        [&](Point p) { return p.x > left && p.x < right ? -200.0 : 0.1 * (p.x - middle.x); });
    int sides[2] = {};
    for (const OffsetFault& fault : faults) {
        const std::size_t at = fault.points.size() / 2;
        const bool is_right = fault.points[at].x > middle.x;
        ++sides[is_right];
        EXPECT_NEAR(fault.points[at].x, is_right ? right : left, d);
        EXPECT_NEAR(std::abs(fault.offset[at]), 200.0, 60.0);
    }
    EXPECT_EQ(sides[0], 1);
    EXPECT_EQ(sides[1], 1);
}

TEST(OffsetFaults, TiltsAndWideBendsAreNone) {
    EXPECT_TRUE(faults_of_rise([](Point p) { return 0.3 * (p.x - middle.x); }).empty());
    for (const OffsetFault& fault : faults_of_rise(
             [](Point p) { return 200.0 * std::clamp((p.x - middle.x) / (8.0 * d), -1.0, 1.0); }))
        for (const double offset : fault.offset)
            EXPECT_LT(std::abs(offset), 100.0);
}

TEST(WeakOffFaults, ByAreaAndDistance) {
    State state = make_state(row(10, r));
    const DiscColumns c = disc_columns(state);
    EXPECT_FALSE(weak_off_faults(state, {}, d).has_value());
    for (std::size_t i = 0; i < 8; ++i)
        c.stratum[i] = 1;
    c.material[0] = c.material[4] = c.material[7] = c.material[9] = weak;
    EXPECT_NEAR(*weak_off_faults(state, {}, d), 3.0 / 8.0, 1e-12);
    Fault fault;
    fault.trace.points = {{8.0 * r, 10.0 * r}, {8.0 * r, -10.0 * r}}; // through disc 4
    EXPECT_NEAR(*weak_off_faults(state, std::vector<Fault>{fault}, d), 2.0 / 8.0, 1e-12);
}

} // namespace
} // namespace listric::fault_trace_test
