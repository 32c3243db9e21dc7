// Concentration measures on densities whose answers are known, and depocentres of a drawn profile.
// Piecewise constant densities are exact; the linear one, sampled in n cells, is off by O(1/n^2).

#include "apps/archive/folder/setting.hpp"
#include "apps/measures/faults/localisation.hpp"
#include "apps/measures/measures.hpp"
#include "apps/measures/paper/blocks.hpp"
#include "apps/measures/strata/cohesion.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "dem/contacts/soft_discs.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace listric::measures_test {

using namespace dem;
using namespace measures;
using archive::make_setting;
namespace {

constexpr std::size_t n = 1000;

/// Density x on (0, 1) in cells of equal area, in shuffled order.
std::vector<double> linear_density() {
    std::vector<double> density(n);
    for (std::size_t k = 0; k < n; ++k)
        density[k * 7 % n] = (static_cast<double>(k) + 0.5) / n;
    return density;
}

const std::vector<double> equal_areas(n, 3.0);

TEST(Gini, UniformIsZero) {
    EXPECT_NEAR(gini(std::vector<double>(n, 2.0), equal_areas), 0.0, 1e-13);
    EXPECT_NEAR(gini(std::vector<double>{2.0, 2.0}, std::vector<double>{1.0, 5.0}), 0.0, 1e-15);
}

TEST(Gini, AllInOnePlaceIsOneLessThatPlace) {
    std::vector<double> density(n, 0.0);
    density[17] = 4.0;
    EXPECT_NEAR(gini(density, equal_areas), 1.0 - 1.0 / n, 1e-13);
}

TEST(Gini, LinearDensity) {
    // Lorenz curve p^2: 1 - 2 / 3.
    EXPECT_NEAR(gini(linear_density(), equal_areas), 1.0 / 3.0, 1.0 / (n * n));
}

TEST(Gini, AreasWeigh) {
    // Lorenz curve through (0.75, 0.5): 1 - 2 (0.1875 + 0.1875) = 0.25.
    EXPECT_NEAR(gini(std::vector<double>{3.0, 1.0}, std::vector<double>{1.0, 3.0}), 0.25, 1e-15);
    EXPECT_NEAR(gini(std::vector<double>{1.0, 3.0, 1.0, 1.0}, std::vector<double>(4, 1.0)), 0.25,
                1e-15);
}

TEST(Gini, NothingHasNoConcentration) {
    EXPECT_EQ(gini(std::vector<double>{0.0, 0.0}, std::vector<double>{1.0, 1.0}), 0.0);
}

TEST(ShareOfDensest, LinearDensity) {
    for (double share : {0.1, 0.25, 0.5, 1.0})
        EXPECT_NEAR(share_of_densest(linear_density(), equal_areas, share),
                    1.0 - (1.0 - share) * (1.0 - share), 1e-12);
}

TEST(ShareOfDensest, SplitsCells) {
    // The densest cell has a quarter of the area and half of the amount.
    const std::vector<double> density{1.0, 3.0}, area{3.0, 1.0};
    EXPECT_NEAR(share_of_densest(density, area, 0.125), 0.25, 1e-15);
    EXPECT_NEAR(share_of_densest(density, area, 0.25), 0.5, 1e-15);
    EXPECT_NEAR(share_of_densest(density, area, 0.625), 0.75, 1e-15);
}

TEST(ShareOfDensest, UniformIsTheAreaShare) {
    EXPECT_NEAR(share_of_densest(std::vector<double>(n, 2.0), equal_areas, 0.1), 0.1, 1e-13);
    EXPECT_EQ(share_of_densest(std::vector<double>(n, 0.0), equal_areas, 0.1), 0.0);
}

/// Thickness by linear interpolation between (index, thickness) points.
struct Drawn {
    std::vector<double> x, thickness;

    explicit Drawn(std::vector<std::pair<int, double>> points) {
        for (std::size_t p = 0; p + 1 < points.size(); ++p)
            for (int k = points[p].first; k < points[p + 1].first; ++k) {
                const double share = static_cast<double>(k - points[p].first) /
                                     (points[p + 1].first - points[p].first);
                thickness.push_back(points[p].second +
                                    share * (points[p + 1].second - points[p].second));
            }
        thickness.push_back(points.back().second);
        for (std::size_t k = 0; k < thickness.size(); ++k)
            x.push_back(100.0 * static_cast<double>(k));
    }
};

TEST(Depocentre, TwoWithAHighBetween) {
    const Drawn d({{0, 0.0}, {10, 600.0}, {20, 200.0}, {40, 1000.0}, {60, 0.0}});
    const std::vector<Depocentre> found = find_depocentres(d.x, d.thickness, 250.0);
    ASSERT_EQ(found.size(), 2u); // the thickest first
    EXPECT_EQ(found[0].x, 4000.0);
    EXPECT_EQ(found[0].thickness, 1000.0);
    EXPECT_EQ(found[0].prominence, 1000.0);
    EXPECT_EQ(found[1].x, 1000.0);
    EXPECT_EQ(found[1].thickness, 600.0);
    EXPECT_EQ(found[1].prominence, 400.0);
}

TEST(Depocentre, RipplesAreNone) {
    const Drawn d({{0, 0.0}, {10, 600.0}, {20, 360.0}, {40, 1000.0}, {60, 0.0}});
    EXPECT_EQ(find_depocentres(d.x, d.thickness, 250.0).size(), 1u);
    EXPECT_EQ(find_depocentres(d.x, d.thickness, 240.0).size(), 2u);
}

TEST(Depocentre, ProminenceIsToTheHigherPass) {
    // Between two thicker ones: passes of 300 and 100, so 700 has a prominence of 400.
    const Drawn d(
        {{0, 0.0}, {10, 900.0}, {20, 300.0}, {30, 700.0}, {40, 100.0}, {50, 1000.0}, {60, 0.0}});
    const std::vector<Depocentre> found = find_depocentres(d.x, d.thickness, 250.0);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[1].prominence, 800.0); // 900, over the pass of 100
    EXPECT_EQ(found[2].prominence, 400.0);
}

TEST(Depocentre, PlateausAndEndsCountOnce) {
    const Drawn plateau({{0, 0.0}, {10, 500.0}, {20, 500.0}, {30, 0.0}});
    ASSERT_EQ(find_depocentres(plateau.x, plateau.thickness, 250.0).size(), 1u);
    const Drawn end({{0, 800.0}, {30, 0.0}});
    const std::vector<Depocentre> found = find_depocentres(end.x, end.thickness, 250.0);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].x, 0.0);
    const Drawn step({{0, 0.0}, {10, 500.0}, {20, 500.0}, {30, 900.0}, {40, 0.0}});
    EXPECT_EQ(find_depocentres(step.x, step.thickness, 250.0).size(), 1u);
}

TEST(Depocentre, NoSedimentNoDepocentre) {
    const Drawn d({{0, 0.0}, {30, 0.0}});
    EXPECT_TRUE(find_depocentres(d.x, d.thickness, 250.0).empty());
    EXPECT_TRUE(find_depocentres({}, {}, 250.0).empty());
}

// ------------------------------------------------------------------------------- ramp-flat-ramp

TEST(RampFlatRamp, PartsOfTheDetachment) {
    const auto parts =
        find_ramp_flat_ramp(make_rigid_base(load_scene({.scene = "rfr"})).surfaces.front().chain);
    ASSERT_TRUE(parts);
    const double kink = 300.0 * std::acos(1.0 - 8.0 / 8.3);
    EXPECT_NEAR(parts->flat_start, 3.5e3 * pi, 1e-6);
    EXPECT_NEAR(parts->flat_end, 3.5e3 * pi + 4705.42, 1e-6);
    EXPECT_NEAR(parts->lower_start, 3.5e3 * pi + 4705.42 + kink, 1e-4);
    EXPECT_NEAR(parts->flat_depth, 7e3, 1e-6);

    const Chain sharp{line({0.0, 0.0}, {1e3, -1e3}), line({1e3, -1e3}, {3e3, -1e3}),
                      line({3e3, -1e3}, {4e3, -3e3}), line({4e3, -3e3}, {9e3, -3e3})};
    const auto corner = find_ramp_flat_ramp(sharp);
    ASSERT_TRUE(corner);
    EXPECT_NEAR(corner->flat_start, std::sqrt(2.0) * 1e3, 1e-9);
    EXPECT_NEAR(corner->flat_end, std::sqrt(2.0) * 1e3 + 2e3, 1e-9);
    EXPECT_EQ(corner->lower_start, corner->flat_end);

    for (const char* simple : {"lis1", "lis2"})
        EXPECT_FALSE(find_ramp_flat_ramp(
            make_rigid_base(load_scene({.scene = simple})).surfaces.front().chain))
            << simple;
}

/// Discs on a square lattice that fills a scene's hanging wall.
State lattice(const Scene& scene, const RigidBase& base) {
    std::vector<support::Disc> discs;
    for (double x = 100.0; x < scene.hanging_wall.length; x += 200.0)
        for (double y = -100.0; y > -scene.hanging_wall.thickness; y -= 200.0)
            if (nearest(base.surfaces.front().chain, {x, y})->distance > 0.0)
                discs.push_back({x, y, 100.0});
    return support::make_state(discs);
}

/// Turns the discs of which `moves(start)` is true about a far point.
template <class Moves> void turn(State& state, double degrees, Moves&& moves) {
    const DiscColumns d = disc_columns(state);
    const double cosine = std::cos(degrees * pi / 180.0), sine = std::sin(degrees * pi / 180.0);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (moves(Point{d.start_x[i], d.start_y[i]})) {
            const double x = d.start_x[i] - 30e3, y = d.start_y[i] - 5e3;
            d.x[i] = 30e3 + cosine * x - sine * y;
            d.y[i] = 5e3 + sine * x + cosine * y;
        }
}

TEST(RampFlatRamp, RotationsOfItsParts) {
    const Scene scene = load_scene(
        {.scene = "rfr",
         .without = {"bonds", "bond_healing", "fault_weakening", "sedimentation", "compaction"}});
    const RigidBase base = make_rigid_base(scene);
    State state = lattice(scene, base);
    state.clock.travel.m = state.clock.extension.m = 1000.0;
    const auto at_breakaway = [](Point p) { return std::hypot(p.x, p.y) < 1.6e3; };
    const auto below_flat = [](Point p) { return p.y < -7e3; };
    turn(state, 80.0, at_breakaway);
    turn(state, 43.0, below_flat);
    turn(state, -15.0, [&](Point p) { return !at_breakaway(p) && !below_flat(p); });
    const Measures m = measure(make_setting(scene, make_parts(scene)), state, base, {});
    EXPECT_NEAR(m.breakaway_rotation.value(), 80.0, 1e-9);
    EXPECT_NEAR(m.lower_block_rotation.value(), 43.0, 1e-9);
    EXPECT_NEAR(m.toe_rotation.value(), -15.0, 1e-9);
    // The upper ramp is 11.0 km long; from the lower one's head 12.3 km are left, from the toe 19.
    const auto known = [&](double extension) {
        state.clock.travel.m = state.clock.extension.m = extension;
        const auto parts = find_ramp_flat_ramp(base.surfaces.front().chain).value();
        const auto r = measure_ramp_flat_ramp(state, base.surfaces.front().chain, parts);
        return std::vector{r.breakaway.has_value(), r.lower_block.has_value(), r.toe.has_value()};
    };
    EXPECT_EQ(known(10.9e3), (std::vector{true, true, true}));
    EXPECT_EQ(known(11.1e3), (std::vector{false, true, true}));
    EXPECT_EQ(known(12.5e3), (std::vector{false, false, true}));
    EXPECT_EQ(known(20.0e3), (std::vector{false, false, false}));
}

TEST(RampFlatRamp, OtherDetachmentsHaveNoSuchParts) {
    const Scene scene = load_scene(
        {.scene = "lis2",
         .without = {"bonds", "bond_healing", "fault_weakening", "sedimentation", "compaction"}});
    const RigidBase base = make_rigid_base(scene);
    State state = lattice(scene, base);
    state.clock.travel.m = state.clock.extension.m = 1000.0;
    turn(state, 19.1, [](Point) { return true; });
    const Measures m = measure(make_setting(scene, make_parts(scene)), state, base, {});
    EXPECT_FALSE(m.breakaway_rotation || m.toe_rotation || m.lower_block_rotation);
    EXPECT_NEAR(m.rollover_tilt.value(), 19.1, 1e-9);
}

TEST(Cutoff, OfTheConstantSlipOfLis2) {
    // Everything slides by e = 10 km along the arc of 30 km about (26, 15) km: the cutoff lies at
    // (6.34, 7.67) km. The lattice shows it to a lattice spacing and a radius.
    const Scene scene = load_scene(
        {.scene = "lis2",
         .without = {"bonds", "bond_healing", "fault_weakening", "sedimentation", "compaction"}});
    const RigidBase base = make_rigid_base(scene);
    State state = lattice(scene, base);
    state.clock.travel.m = state.clock.extension.m = 10e3;
    const DiscColumns d = disc_columns(state);
    const Point centre{30e3 * std::sin(pi / 3.0), 15e3};
    const double cosine = std::cos(1.0 / 3.0), sine = std::sin(1.0 / 3.0);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double x = d.start_x[i] - centre.x, y = d.start_y[i] - centre.y;
        d.x[i] = centre.x + cosine * x - sine * y;
        d.y[i] = centre.y + sine * x + cosine * y;
    }
    const Measures m = measure(make_setting(scene, make_parts(scene)), state, base, {});
    EXPECT_NEAR(m.cutoff.value().x, 6.34e3, 250.0);
    EXPECT_NEAR(m.cutoff.value().y, 7.67e3, 250.0);
    EXPECT_NEAR(m.rollover_tilt.value(), 19.0986, 1e-3);
}

TEST(Measures, OfTheRollAreNoneBeyondTheArc) {
    const Scene scene = load_scene(
        {.scene = "lis1",
         .without = {"bonds", "bond_healing", "fault_weakening", "sedimentation", "compaction"}});
    const RigidBase base = make_rigid_base(scene);
    State state = lattice(scene, base);
    turn(state, 70.0, [](Point) { return true; });
    for (const auto& [extension, is_there] : {std::pair(23e3, true), std::pair(24e3, false)}) {
        state.clock.travel.m = state.clock.extension.m = extension;
        const Measures m = measure(make_setting(scene, make_parts(scene)), state, base, {});
        EXPECT_EQ(m.rollover_tilt.has_value(), is_there);
        EXPECT_EQ(m.predicted_tilt.has_value(), is_there);
        EXPECT_TRUE(m.area_balance && m.cutoff);
    }
}

TEST(Measures, OfAreaAreNoneWhereRockWasEroded) {
    const Scene scene = load_scene(
        {.scene = "lis1",
         .without = {"bonds", "bond_healing", "fault_weakening", "sedimentation", "compaction"}});
    const RigidBase base = make_rigid_base(scene);
    State state = lattice(scene, base);
    state.clock.travel.m = state.clock.extension.m = 2e3;
    const Setting setting = make_setting(scene, make_parts(scene));
    const auto known = [&] {
        const Measures m = measure(setting, state, base, {});
        EXPECT_EQ(m.area_balance.has_value(), m.dilation_area.has_value());
        EXPECT_EQ(m.area_balance.has_value(), m.depth_to_detachment.has_value());
        EXPECT_TRUE(m.area_balance || !(m.inclined_shear_angle || m.normals_misfit));
        EXPECT_TRUE(m.rollover_tilt && m.predicted_tilt);
        return m.area_balance.has_value();
    };
    EXPECT_TRUE(known());
    // A hundredth of 2 x 15 km2 may be gone: 1/2000 of a hanging wall of 40 x 15 km2.
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    std::vector<std::int32_t> kept;
    for (std::size_t i = 0; i < d.y.size(); ++i)
        if (i % 1000 != 0)
            kept.push_back(static_cast<std::int32_t>(i));
    reorder_discs(state, kept);
    EXPECT_FALSE(known());
    state.clock.travel.m = state.clock.extension.m = 20e3;
    EXPECT_TRUE(known());
}

TEST(Measures, OfWeakenedVolumeAreNoneWhereThereIsMoreSedimentThanRock) {
    const Scene scene = load_scene({.scene = "lis1"});
    const ModelParts parts = make_parts(scene);
    State state = lattice(scene, parts.base);
    add_enlarged_columns(state);
    const auto known = [&] {
        const auto effect =
            std::ranges::find(scene.effects, "fault_weakening",
                              [](const EffectPart& part) { return part.effect->name; });
        const std::vector<Measure<Observation>>& declared = effect->effect->measures;
        EXPECT_EQ(declared.at(0).name, "weak_fraction");
        EXPECT_EQ(declared.at(1).name, "volume_error_fraction");
        return declared.at(1).value({scene, parts, state, {}}).has_value();
    };
    EXPECT_TRUE(known());
    state.ledger.deposited = 1.2 * state.ledger.initial;
    EXPECT_FALSE(known());
    state.ledger.removed = 0.3 * state.ledger.initial;
    EXPECT_TRUE(known());
}

TEST(InterveningHigh, BetweenTheFirstDepocentreAndTheMostProminentBeyond) {
    const Drawn d(
        {{0, 0.0}, {10, 900.0}, {20, 350.0}, {30, 700.0}, {40, 300.0}, {50, 1000.0}, {60, 0.0}});
    const auto high = find_intervening_high(d.x, d.thickness, 250.0);
    ASSERT_TRUE(high.has_value());
    EXPECT_EQ(d.x[*high], 4000.0);
    const Drawn one({{0, 0.0}, {10, 900.0}, {60, 0.0}});
    EXPECT_FALSE(find_intervening_high(one.x, one.thickness, 250.0).has_value());
}

TEST(OldSediment, BondedShareOfDeepAndOldPairs) {
    using namespace support;
    constexpr double r = 100.0;
    // Touching discs in a row 1,600 m below the level: basement, three old ones, two young ones.
    State state = make_state(row(6, r));
    const DiscColumns d = disc_columns(state);
    state.clock.travel.m = state.clock.extension.m = 5000.0;
    for (std::size_t i = 0; i < 6; ++i) {
        d.y[i] = -1600.0;
        d.radius[i] = 1.001 * r;
        d.stratum[i] = i == 0 ? 0 : i < 4 ? 1 : 9;
        d.start_travel[i] = i < 4 ? 500.0 : 4000.0;
    }
    const auto level = [](double y) { return TargetLine({{0.0, y}}); };
    find_contacts(state, {});
    EXPECT_EQ(bonded_share_of_old_sediment(state, level(0.0), 1500.0, 2000.0), 0.0);
    bond(state, find_pair(state, 1, 2), 1.0f, 1.0f);
    EXPECT_EQ(bonded_share_of_old_sediment(state, level(0.0), 1500.0, 2000.0), 0.5);
    EXPECT_EQ(bonded_share_of_old_sediment(state, level(0.0), 1500.0, 500.0),
              0.25); // the young ones too
    EXPECT_FALSE(bonded_share_of_old_sediment(state, level(-200.0), 1500.0, 2000.0).has_value());

    const auto profile = bonded_profile_of_old_sediment(state, level(0.0), 2000.0);
    ASSERT_EQ(profile.size(), 1u);
    EXPECT_EQ(profile[0].depth, 2000.0); // 1,600 m are between 1.5 and 2.5 km
    EXPECT_EQ(profile[0].share, 0.5);
    EXPECT_EQ(bonded_profile_of_old_sediment(state, level(-200.0), 2000.0).at(0).depth, 1000.0);
    EXPECT_TRUE(bonded_profile_of_old_sediment(state, level(0.0), 9000.0).empty());
    // A target line counts where the discs are.
    const TargetLine sloping({{-1e4, -200.0 - 1e4}, {1e4, -200.0 + 1e4}});
    EXPECT_FALSE(bonded_share_of_old_sediment(state, sloping, 2000.0, 2000.0).has_value());
    for (std::size_t i = 0; i < 6; ++i)
        d.x[i] += 1000.0;
    EXPECT_EQ(bonded_share_of_old_sediment(state, sloping, 2000.0, 2000.0), 0.5);
    EXPECT_EQ(bonded_profile_of_old_sediment(state, sloping, 2000.0).back().depth, 3000.0);
}

} // namespace
} // namespace listric::measures_test
