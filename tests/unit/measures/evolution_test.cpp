// Structural measures of states whose structure is known.

#include "apps/archive/folder/setting.hpp"
#include "apps/measures/basin/dilation.hpp"
#include "apps/measures/evolution.hpp"
#include "apps/measures/faults/fault_throw.hpp"
#include "apps/measures/faults/main_faults.hpp"
#include "apps/measures/strata/rock.hpp"
#include "dem/events/fault_weakening.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace listric::evolution_test {

using namespace dem;
using namespace measures;
namespace {

using namespace support;

constexpr double r = 93.1, d = 2.0 * r;
constexpr double degree = pi / 180.0;

/// Simple shear of `amount` on a plane that dips by `dip` and falls right or left.
ShearField sheared(double dip, bool falls_right, bool reverse, double amount) {
    const Point t{(falls_right ? 1.0 : -1.0) * std::cos(dip * degree), -std::sin(dip * degree)};
    const Point n{-t.y, t.x};
    // The side above the plane is left of t where it falls right; it moves down unless reverse.
    const double g = (falls_right != reverse ? 1.0 : -1.0) * amount;
    ShearField field;
    field.x = field.y = {0.0};
    field.xx = {g * t.x * n.x};
    field.xy = {g * t.x * n.y};
    field.yx = {g * t.y * n.x};
    field.yy = {g * t.y * n.y};
    return field;
}

TEST(ShearPlane, DipDirectionAndSenseOfSimpleShear) {
    for (double dip : {20.0, 45.0, 60.0, 80.0})
        for (bool falls_right : {true, false})
            for (bool reverse : {true, false}) {
                SCOPED_TRACE(testing::Message() << dip << " " << falls_right << " " << reverse);
                const ShearPlane plane = shear_plane(sheared(dip, falls_right, reverse, 0.3), 0);
                EXPECT_NEAR(plane.strain, 0.3, 1e-12);
                EXPECT_NEAR(plane.dip, dip, 1e-9);
                EXPECT_EQ(plane.falls_right, falls_right);
                EXPECT_EQ(plane.reverse, reverse);
            }
}

TEST(ThrowAgeCorrelation, FallingAndRisingAndTooFew) {
    EXPECT_NEAR(*throw_age_correlation({{0, 500}, {1, 400}, {2, 300}, {5, 100}, {9, 0}}), -1.0,
                1e-12);
    EXPECT_NEAR(*throw_age_correlation({{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}}), 1.0, 1e-12);
    // One neighbouring pair exchanged: 1 - 6 * 2 / 120.
    EXPECT_NEAR(*throw_age_correlation({{0, 5}, {1, 3}, {2, 4}, {3, 2}, {4, 1}}), -0.9, 1e-12);
    EXPECT_FALSE(throw_age_correlation({{0, 4}, {1, 3}, {2, 2}, {3, 1}}).has_value());
}

/// Layers cut by a fault that falls right by 60 degrees; the right side has slid 20 diameters down
/// along it, far more than the discs beside the trace reach, and the footwall has turned.
TEST(PreRiftThrow, OfSidesThatHavePartedAndTurned) {
    for (double turn : {0.0, 8.0}) {
        std::vector<Disc> discs = cloud(110, 100, r, 5);
        for (Disc& disc : discs)
            disc.y -= 99.0 * std::sqrt(3.0) * r;
        State state = make_state(discs);
        const DiscColumns c = disc_columns(state);
        const Point through{110.0 * r, -80.0 * r};
        const Point down{std::cos(60.0 * degree), -std::sin(60.0 * degree)};
        for (std::size_t i = 0; i < c.x.size(); ++i) {
            const double s = down.x * (c.y[i] - through.y) - down.y * (c.x[i] - through.x);
            if (s > 0.0) {
                c.x[i] += 20.0 * d * down.x;
                c.y[i] += 20.0 * d * down.y;
            } else {
                // About a point of the fault, so that layers on it turn with the block.
                const double a = turn * degree, x = c.x[i] - through.x, y = c.y[i] - through.y;
                c.x[i] = through.x + std::cos(a) * x - std::sin(a) * y;
                c.y[i] = through.y + std::sin(a) * x + std::cos(a) * y;
            }
        }
        std::vector<Point> trace;
        for (int k = -18; k <= 18; ++k)
            trace.push_back({through.x + k * d * down.x, through.y + k * d * down.y});
        const std::map<int, Cutoffs> cutoffs = fault_cutoffs(state, {.trace = trace});
        EXPECT_GE(cutoffs.size(), 3u);
        // A layer that started h above the pivot meets the fault there in the footwall at the
        // height h sin 60 / sin(120 - turn), in the hanging wall at h less the slip's height.
        const double sine = std::sin(60.0 * degree), turned = std::sin((120.0 - turn) * degree);
        std::vector<double> expected;
        for (const auto& [number, at] : cutoffs) {
            const double h = 1000.0 * number - through.y;
            expected.push_back(20.0 * d * sine + h * (sine / turned - 1.0));
            EXPECT_TRUE(at.is_resolved);
            EXPECT_NEAR(at.height(), expected.back(), 0.1 * d) << turn << " " << number;
        }
        EXPECT_NEAR(*pre_rift_throw_of(cutoffs), std::ranges::max(expected), 0.1 * d);
        for (std::int32_t& stratum : c.stratum)
            stratum = 1;
        EXPECT_FALSE(pre_rift_throw_of(fault_cutoffs(state, {.trace = trace})).has_value());
    }
}

TEST(Basins, OfTheDepthOfThePreRiftTop) {
    Profile profile;
    for (int k = 0; k < 400; ++k) {
        const double x = 100.0 * k;
        profile.x.push_back(x);
        profile.pre_rift_top.push_back(-4e3 * std::exp(-std::pow((x - 4e3) / 3e3, 2.0)) -
                                       1e3 * std::exp(-std::pow((x - 20e3) / 2e3, 2.0)) -
                                       100.0 * std::exp(-std::pow((x - 32e3) / 2e3, 2.0)));
    }
    const std::vector<Depocentre> basins = find_basins(profile);
    ASSERT_EQ(basins.size(), 2u); // the third is too shallow
    EXPECT_NEAR(basins[0].x, 4e3, 100.0);
    EXPECT_NEAR(basins[1].x, 20e3, 100.0);
    EXPECT_NEAR(basins[1].prominence, 1e3, 50.0);
}

/// Ten sediment discs 1 km deep; one of them has the porosity of a place twice as deep. The discs
/// of the surface are of basement; what was just laid down on them is no burial yet.
TEST(Compaction, PorosityBesideThatOfTheDepth) {
    std::vector<Disc> discs = row(10, r);
    for (Disc& disc : discs)
        disc.y = -1e3 - r;
    std::ranges::copy(row(10, r), std::back_inserter(discs));
    for (std::size_t i = 10; i < discs.size(); ++i)
        discs[i].y = -r;
    discs.push_back({r, 5.0 * r, r});
    State state = make_state(discs);
    state.clock.travel.m = state.clock.extension.m = 500.0;
    const DiscColumns c = disc_columns(state);
    const auto mass_of = [](double depth) { // of grains in a disc
        return 1300.0 * pi * r * r * (1.0 - 0.5 * std::exp(-4e-4 * depth)) / 0.5;
    };
    for (std::size_t i = 0; i < discs.size(); ++i) {
        c.stratum[i] = i < 10 || i == 20 ? 1 : 0;
        c.start_travel[i] = i == 20 ? 450.0 : 0.0;
        c.mass[i] = mass_of(i == 3 ? 2e3 + r : 1e3 + r);
    }
    Setting setting;
    setting.sediment = {Target(0.0), 0.5, 1300.0, 4e-4};
    const NamedNumbers found = measure_rock(setting, state);
    const std::map<std::string, double> numbers(found.begin(), found.end());
    const double share = c.mass[3] / (9.0 * c.mass[0] + c.mass[3]);
    EXPECT_NEAR(numbers.at("porosity_error"), share * (1.0 - std::exp(-0.4)), 1e-12);
    EXPECT_NEAR(numbers.at("porosity_off_fraction"), share, 1e-12);
}

/// A fault of 4 km's height that dips by 63 degrees either way from its middle.
Fault fault_at(double x, double born_at, bool falls_right = true, double run = 0.5) {
    Fault f;
    for (int k = 0; k <= 40; ++k)
        f.trace.points.push_back(
            {x + (falls_right ? run : -run) * 100.0 * (k - 20), -3e3 - 100.0 * k});
    f.dip = std::atan(1.0 / run) / degree;
    f.born_at = dem::Extension(born_at);
    f.born_travel = dem::Travel(born_at);
    return f;
}

TEST(InnerFault, StepsTowardTheBreakaway) {
    const Fault outer = fault_at(31e3, 1e3), antithetic = fault_at(38e3, 1e3, false);
    EXPECT_EQ(inner_fault_step({}), 0.0);
    EXPECT_EQ(inner_fault_step({outer, antithetic}), 0.0); // of one age
    EXPECT_NEAR(inner_fault_step({outer, fault_at(26e3, 9e3), antithetic}), 5e3, 1.0);
    EXPECT_EQ(inner_fault_step({outer, fault_at(26e3, 2e3)}), 0.0);             // hardly younger
    EXPECT_EQ(inner_fault_step({outer, fault_at(34e3, 9e3), antithetic}), 0.0); // further out
    EXPECT_EQ(inner_fault_step({outer, fault_at(26e3, 9e3, true, 2.0)}), 0.0);  // not steep
    Fault reverse = fault_at(26e3, 9e3);
    reverse.normal = false;
    EXPECT_EQ(inner_fault_step({outer, reverse}), 0.0);
}

/// A packing is turned, or pulled apart by a share of its width: everywhere, or on one plane.
TEST(Dilation, OfThePackingAlone) {
    RigidBase base;
    base.surfaces = {{"detachment", {line({-1e6, -1e6}, {1e6, -1e6})}, 0.0}};
    Setting setting;
    setting.thickness = 15e3;
    const std::vector<Disc> discs = cloud(60, 60, r, 3);
    const auto measured = [&](auto&& move) {
        State state = make_state(discs);
        const std::vector<Past> past{remember(setting, base, state, {})};
        const DiscColumns c = disc_columns(state);
        for (std::size_t i = 0; i < c.x.size(); ++i) {
            const Point p = move({c.x[i], c.y[i]});
            c.x[i] = p.x;
            c.y[i] = p.y;
        }
        state.clock.travel.m = state.clock.extension.m = 1e3;
        const auto found = measure_dilation(RunSoFar(setting, base, state, past));
        EXPECT_NEAR(found.at(1).second, found.at(0).second / (1e3 * 15e3), 1e-12);
        double all = 0.0;
        for (double area : past[0].rock.cells)
            all += area;
        return found.at(0).second / all;
    };
    const double middle = 60.0 * r, share = 0.01, gap = 2.0 * share * middle;
    EXPECT_NEAR(measured([&](Point p) {
                    return Point{0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y};
                }),
                0.0, 1e-9);
    EXPECT_NEAR(measured([&](Point p) { return Point{(1.0 + share) * p.x, p.y}; }), share, 2e-4);
    // The cells that are measured lie within about a disc of the outline.
    EXPECT_NEAR(measured([&](Point p) {
                    return Point{p.x + (p.x > middle ? gap : 0.0), p.y};
                }),
                share, 0.04 * share);
}

/// A pressed square of rock whose contacts give back half of their overlap: all of its growth is
/// elastic but where rock was weakened meanwhile, and the overlap that is left counts for nothing.
TEST(Dilation, PartOfItIsElastic) {
    constexpr double pressed = 0.02, share = 0.01; // overlap over length, and what is given back
    RigidBase base;
    base.surfaces = {{"detachment", {line({-1e6, -1e6}, {1e6, -1e6})}, 0.0}};
    Setting setting;
    setting.thickness = 15e3;
    std::vector<Disc> discs;
    for (int i = 0; i < 1600; ++i)
        discs.push_back(
            {2.0 * r * (1.0 - pressed) * (i % 40), 2.0 * r * (1.0 - pressed) * (i / 40), r});
    State state = make_state(discs);
    find_contacts(state, base);
    const std::vector<Past> past{remember(setting, base, state, {})};
    const double grown = (1.0 - pressed + share) / (1.0 - pressed);
    const DiscColumns c = disc_columns(state);
    for (std::size_t i = 0; i < c.x.size(); ++i) {
        c.x[i] *= grown;
        c.y[i] *= grown;
    }
    state.clock.travel.m = state.clock.extension.m = 1e3;
    const auto measured = [&] {
        const NamedNumbers found = measure_dilation(RunSoFar(setting, base, state, past));
        return std::map<std::string, double>(found.begin(), found.end());
    };
    const auto sound = measured();
    EXPECT_NEAR(sound.at("elastic_area_m2") / sound.at("rock_dilation_m2"),
                2.0 * share / (grown * grown - 1.0), 1e-3);
    EXPECT_NEAR(sound.at("elastic_area_fraction"), sound.at("elastic_area_m2") / (1e3 * 15e3),
                1e-12);
    for (std::size_t i = 0; i < c.x.size() / 2; ++i)
        c.material[i] = weak;
    const auto half_weak = measured();
    EXPECT_NEAR(half_weak.at("elastic_area_m2") / sound.at("elastic_area_m2"), 0.5, 0.02);
    EXPECT_EQ(half_weak.at("rock_dilation_m2"), sound.at("rock_dilation_m2"));
}

TEST(StillGround, RisesByWhatTheDiscsThereDo) {
    RigidBase base;
    base.surfaces = {{"detachment", {line({0.0, -1e4}, {1e5, -1e4})}, 0.0}};
    Setting setting;
    setting.length = 40e3;
    setting.thickness = 15e3;
    setting.has_detachment = true;
    State state = make_state(row(200, 100.0)); // to 40 km
    const DiscColumns c = disc_columns(state);
    for (std::size_t i = 0; i < c.x.size(); ++i)
        c.y[i] += c.start_x[i] > 36e3 ? -70.0 : 500.0;
    state.clock.travel.m = state.clock.extension.m = 1e3;
    EXPECT_NEAR(measure(setting, state, base, {}).still_ground.value(), -70.0, 1e-9);
    setting.has_detachment = false; // all of a box moves
    EXPECT_FALSE(measure(setting, state, base, {}).still_ground);
}

/// Collapse grabens beyond a basin at 5 km: one of them is there alone, then both. They have moved
/// with the right wall since.
TEST(Grabens, TheOneThatIsThereFirst) {
    for (double alone : {30e3, 20e3}) {
        Setting setting;
        setting.length = 40e3;
        setting.thickness = 15e3;
        RigidBase base;
        base.surfaces = {{"detachment", {line({0.0, -1e4}, {1e5, -1e4})}, 0.0}};
        State state = make_state(row(20, r));
        const auto past = [&](double extension, std::vector<double> grabens) {
            state.clock.travel.m = state.clock.extension.m = extension;
            Past p{DiscPlaces(state), {{5e3, 4e3, 4e3}}, {}};
            for (double x : grabens)
                p.basins.push_back({x + extension, 1e3, 500.0});
            return p;
        };
        // In the second moment two maxima of one graben.
        const std::vector<Past> story{past(0.0, {}), past(1e3, {alone, alone + 1e3}),
                                      past(2e3, {alone}), past(3e3, {20e3, 30e3})};
        state.clock.travel.m = state.clock.extension.m = 4e3;
        const NamedNumbers found = measure_evolution(setting, base, state, {}, {}, {}, story);
        const std::map<std::string, double> numbers(found.begin(), found.end());
        EXPECT_EQ(numbers.at("first_graben_at_m"), 1e3);
        EXPECT_EQ(numbers.at("second_graben_at_m"), 3e3);
        EXPECT_EQ(numbers.at("outer_graben_first"), alone == 30e3 ? 1.0 : 0.0);
    }
}

/// Rock above the kink that shears as one on reverse planes; fault detection knows one of them.
TEST(ReverseFaults, AboveTheKink) {
    std::vector<Disc> discs = hexagonal(38, 36, r);
    for (Disc& disc : discs) {
        disc.x += 9.3e3;
        disc.y -= 6.5e3;
    }
    State state = make_state(discs);
    const DiscColumns c = disc_columns(state);
    for (std::size_t i = 0; i < discs.size(); ++i)
        c.stratum[i] = c.y[i] > -2e3 ? 1 : 0;
    state.clock.travel.m = state.clock.extension.m = 5e3;
    const std::vector<Past> past{{DiscPlaces(state), {}, {}}};
    const ShearField shear = sheared(50.0, false, true, 0.02);
    const Point middle{12e3, -3.5e3};
    std::size_t near = 0;
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const double x = c.x[i] - middle.x, y = c.y[i] - middle.y;
        c.x[i] += shear.xx[0] * x + shear.xy[0] * y;
        c.y[i] += shear.yx[0] * x + shear.yy[0] * y;
        near += std::hypot(c.x[i] - middle.x, c.y[i] - middle.y) < 2.5 * d;
    }
    state.clock.travel.m = state.clock.extension.m = 10e3;

    const FaultWeakeningParameters weakening;
    Setting setting;
    setting.length = 40e3;
    setting.thickness = 15e3;
    setting.has_detachment = true;
    setting.output_interval = 500.0;
    setting.youngest_sediment = dem::Travel(weakening.youngest_sediment * setting.calendar.rate());
    setting.detection_circle = weakening.circle_diameters;
    auto detection = std::make_unique<FaultWeakening>(weakening, 0.01, 9.81);
    const double segments[4][5] = {// x, y, angle, slip, found at
                                   {middle.x, middle.y, 50.0, 90.0, 8e3},
                                   {middle.x + 2e3, middle.y, 50.0, -90.0, 8e3}, // normal
                                   {middle.x - 2e3, middle.y, 130.0, 90.0, 8e3}, // falls right
                                   {middle.x, middle.y + 2e3, 50.0, 90.0, 4e3}}; // before
    detection->memory.resize(4);
    for (std::size_t k = 0; k < 4; ++k) {
        int column = 0;
        for (const char* name : {"x_m", "y_m", "angle_rad", "slip_m", "found_at_m"}) {
            const double value = segments[k][column];
            detection->memory.get<double>(name)[k] = column == 2 ? value * degree : value;
            ++column;
        }
    }
    std::vector<std::unique_ptr<Event>> events;
    events.push_back(std::move(detection));
    RigidBase base;
    base.surfaces = {
        {"detachment",
         {arc({0.0, 0.0}, {0.0, -1.0}, 7e3, 90.0 * degree), line({7e3, -7e3}, {12e3, -7e3}),
          arc({12e3, -7e3}, {0.0, -1.0}, 8e3, 90.0 * degree), line({20e3, -15e3}, {100e3, -15e3})},
         0.0}};
    const NamedNumbers found =
        measure_evolution(setting, base, state, {}, {}, archive::fault_segments(events), past);
    const std::map<std::string, double> numbers(found.begin(), found.end());
    EXPECT_NEAR(numbers.at("kink_reverse_strain_share"), 1.0, 1e-9);
    EXPECT_NEAR(numbers.at("kink_reverse_fault_share"),
                static_cast<double>(near) / static_cast<double>(discs.size()), 1e-9);
    EXPECT_NEAR(numbers.at("kink_synrift_shortening"), -shear.xx[0], 1e-6);
    EXPECT_GT(-shear.xx[0], 0.0); // reverse faults shorten
}

} // namespace
} // namespace listric::evolution_test
