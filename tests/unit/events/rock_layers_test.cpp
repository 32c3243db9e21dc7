// Layers of rock: bonds of a contact from the weaker of its two rocks, what weakens into what, and
// genesis. A layer's area is that of the power cells of its discs, which are of it by their centre:
// each of the some 2 x 27 discs on its top and bottom is off by at most half a disc, at random, so
// that their sum is off by 0.29 sqrt(54) discs of 135, 1.6 %; 2 % is asked for with this seed. A
// soft layer is held to 0.2 % by genesis, on top of which come the third equilibrium and bonding.

#include "dem/contacts/bond.hpp"
#include "dem/contacts/power_cell.hpp"
#include "dem/contacts/soft_discs.hpp"
#include "dem/events/bond_healing.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/old_faults.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::rock_layers_test {

using namespace dem;
namespace {

using namespace support;

constexpr double radius = 150.0, length = 8e3, depth = 5e3, top = 1.5e3, thickness = 1.5e3;
constexpr Material soft{8.5e8, 3.19e8, 0.0, false, true};

/// A box with one layer of the fourth material.
GenesisRequest request(const Material& material, double layer_density = 2600.0) {
    GenesisRequest r = packing_request(length, depth, radius);
    r.bonds = BondStrength{};
    r.materials.push_back(material);
    r.layers = {
        {TargetLine({{0.0, -top}}), TargetLine({{0.0, -top - thickness}}), 3, layer_density}};
    return r;
}

double area_of_layer(const State& state, const RigidBase& base) {
    const auto layer = state.discs.get<std::uint8_t>("layer");
    std::vector<std::int32_t> rows;
    for (std::size_t i = 0; i < layer.size(); ++i)
        if (layer[i] == 1)
            rows.push_back(static_cast<std::int32_t>(i));
    double area = 0.0;
    for (const PowerCell& cell : power_cells(state, base, rows))
        area += cell.area;
    return area;
}

TEST(RockLayers, OfTheBasementByAnotherNameChangeNothing) {
    GenesisRequest without = request(Material{});
    without.layers.clear();
    without.materials.pop_back();
    const State plain = settled(without), layered = settled(request(Material{}));
    for (const Column& column : plain.discs.columns()) {
        if (column.name != "material") {
            EXPECT_TRUE(
                column.values ==
                std::ranges::find(layered.discs.columns(), column.name, &Column::name)->values)
                << column.name;
        }
    }
    EXPECT_EQ(hash(plain.contacts), hash(layered.contacts));
    EXPECT_EQ(hash(plain.base_contacts), hash(layered.base_contacts));
    const auto layer = layered.discs.get<std::uint8_t>("layer");
    for (std::size_t i = 0; i < layer.size(); ++i)
        EXPECT_EQ(disc_columns(layered).material[i], layer[i] == 1 ? 3 : 0);
}

TEST(RockLayers, HaveTheirThicknessTimesLengthAfterGenesis) {
    const GenesisRequest stiff = request(Material{1.7e11, 6.38e10, 0.05, false}, 2200.0);
    const State of_stiff = settled(stiff);
    EXPECT_NEAR(area_of_layer(of_stiff, stiff.base), thickness * length, 0.02 * thickness * length);
    const GenesisRequest of_mica = request(soft);
    const State state = settled(of_mica);
    EXPECT_NEAR(area_of_layer(state, of_mica.base), thickness * length, 0.02 * thickness * length);
    const double before = [&] {
        const auto area = state.discs.get<double>("rock_area");
        return std::accumulate(area.begin(), area.end(), 0.0);
    }();
    EXPECT_NEAR(area_of_layer(state, of_mica.base), before, 5e-3 * before);
    EXPECT_EQ(std::ranges::count(disc_columns(state).material, 3),
              std::ranges::count(state.discs.get<std::uint8_t>("layer"), 1));
}

/// With a radius of their rock, which the property update keeps; of zero they would shrink away.
TEST(RockLayers, SoftOnesStayAsTheyAreWithoutGravity) {
    GenesisRequest weightless = request(soft);
    weightless.physics.gravity = 0.0;
    State state = settled(weightless);
    const std::vector<double> radius_before(disc_columns(state).radius.begin(),
                                            disc_columns(state).radius.end());
    const auto layer = state.discs.get<std::uint8_t>("layer");
    const auto rock_radius = state.discs.get<double>("rock_radius");
    for (std::size_t i = 0; i < layer.size(); ++i)
        if (layer[i] == 1) {
            EXPECT_EQ(rock_radius[i], radius_before[i]);
        }
    for (int update = 0; update < 5; ++update)
        keep_volume(state, weightless.base, VolumeKeeping{2.0 * state.mean_radius}, 0.0);
    for (std::size_t i = 0; i < layer.size(); ++i)
        EXPECT_NEAR(disc_columns(state).radius[i], radius_before[i], 0.02 * radius_before[i]);
}

TEST(RockLayers, HaveTheirDensity) {
    const State light = settled(request(Material{}, 1300.0)), equal = settled(request(Material{}));
    const auto layer = light.discs.get<std::uint8_t>("layer");
    const ConstDiscColumns d = disc_columns(light);
    double in_layer = 0.0, elsewhere = 0.0, discs = 0.0, others = 0.0;
    for (std::size_t i = 0; i < layer.size(); ++i) {
        const double size = d.radius[i] * d.radius[i];
        (layer[i] == 1 ? in_layer : elsewhere) += d.mass[i];
        (layer[i] == 1 ? discs : others) += size;
    }
    EXPECT_NEAR(in_layer / discs, 0.5 * elsewhere / others, 1e-9 * in_layer / discs);
    EXPECT_LT(light.ledger.initial, equal.ledger.initial);
}

TEST(RockLayers, AreBondedAsTheirMaterialsSay) {
    const auto bonds = [](const Material& material) {
        const State state = settled(request(material));
        const ConstContactColumns c = contact_columns(state);
        const auto m = disc_columns(state).material;
        std::array<int, 3> count{}; // within the rock, across a boundary, within the layer
        for (std::size_t k = 0; k < c.first.size(); ++k)
            if (c.bonded[k])
                ++count[(m[static_cast<std::size_t>(c.first[k])] == 3) +
                        (m[static_cast<std::size_t>(c.second[k])] == 3)];
        return count;
    };
    const auto welded = bonds(Material{});
    EXPECT_GT(welded[1], 20);
    Material loose;
    loose.bondable = false;
    EXPECT_EQ(bonds(loose)[1], 0);
    EXPECT_EQ(bonds(loose)[2], 0);
    EXPECT_EQ(bonds(loose)[0], welded[0]);
    Material parted;
    parted.is_welded = false;
    EXPECT_EQ(bonds(parted)[1], 0);
    EXPECT_EQ(bonds(parted)[2], welded[2]);
}

/// Two discs that touch, of the basement and of a fourth material.
struct Pair {
    State state = make_state(row(2, 100.0));

    explicit Pair(const Material& material) {
        state.materials.push_back(material);
        disc_columns(state).material[1] = 3;
        disc_columns(state).x[1] -= 1.0;
        find_contacts(state, {});
    }
    float strength(const BondStrength& of_basement) {
        install_bond(state, 0, of_basement, 0);
        return contact_columns(state).tensile_strength[0];
    }
};

TEST(RockLayers, TheWeakerRockOfAContactDecides) {
    const BondStrength strong, half{1.0e4, 0.25e4, 1.0e8, 0.25e8};
    Material weaker, stronger;
    weaker.bonds = half;
    stronger.bonds = BondStrength{4.0e4, 1.0e4, 4.0e8, 1.0e8};
    const float alone = Pair(Material{}).strength(strong);
    EXPECT_EQ(Pair(stronger).strength(strong), alone);
    EXPECT_FLOAT_EQ(Pair(weaker).strength(strong), 0.5f * alone);
    Material as_force; // as strong on this section of 200 m
    as_force.bonds = BondStrength{200 * 1.0e4, 200 * 0.25e4, 1e10, 0.0, StrengthReading::force};
    EXPECT_FLOAT_EQ(Pair(as_force).strength(strong), 0.5f * alone);
}

TEST(RockLayers, HealOnlyWhereTheyMayBeBonded) {
    const auto heals = [](const Material& material) {
        Pair pair(material);
        BondHealing healing({}, BondStrength{}, 0.01);
        healing.begin(pair.state);
        pair.state.clock.travel.m = pair.state.clock.extension.m = 1e3;
        healing.apply(pair.state, {});
        return contact_columns(pair.state).bonded[0] != 0;
    };
    Material parted;
    parted.is_welded = false;
    EXPECT_TRUE(heals(Material{}));
    EXPECT_FALSE(heals(parted));
    EXPECT_FALSE(heals(soft));
}

TEST(RockLayers, BecomeTheirOwnWeakRock) {
    std::vector<Material> materials(3);
    materials.push_back(Material{}); // a layer
    materials.push_back(Material{}); // what it becomes
    materials.back().weak_of = 3;
    materials.push_back(soft); // a layer that becomes nothing
    EXPECT_EQ(weakened(materials, basement), weak);
    EXPECT_EQ(weakened(materials, sediment), weak);
    EXPECT_EQ(weakened(materials, 3), 4);
    for (const std::uint8_t m : {std::uint8_t{weak}, std::uint8_t{4}, std::uint8_t{5}})
        EXPECT_EQ(weakened(materials, m), no_material);
    EXPECT_TRUE(is_weak(materials, 4));
    EXPECT_FALSE(is_weak(materials, 5));
    EXPECT_TRUE(is_soft(materials, weak));
    EXPECT_TRUE(is_soft(materials, 4));
    EXPECT_TRUE(is_soft(materials, 5));
    EXPECT_FALSE(is_soft(materials, 3));
}

TEST(OldFaults, AreWeakBeforeTheFirstCycle) {
    std::vector<Disc> discs = cloud(30, 30, 100.0, 4);
    State state = make_state(discs);
    Material layer = soft; // is never weakened
    state.materials.push_back(layer);
    bond_all(state, {});
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.y[i] > 4000.0)
            d.material[i] = 3;
    const OldFaultsParameters::Fault fault{{{1000.0, 500.0}, {3000.0, 4800.0}}, 500.0};
    OldFaults event({{fault}, 0.75}, 9.81);
    event.begin(state);
    const std::vector<double> before(d.radius.begin(), d.radius.end());
    EXPECT_TRUE(event.start(state, {}));
    const auto rock_radius = state.discs.get<double>("rock_radius");
    const Point along = unit(fault.points[1] - fault.points[0]);
    int count = 0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const Point at = Point{d.x[i], d.y[i]} - fault.points[0];
        const double on = dot(along, at), off = std::abs(cross(along, at));
        if (d.material[i] == weak) {
            ++count;
            EXPECT_LT(off, 250.0);
            EXPECT_GT(d.radius[i], before[i]);
            EXPECT_EQ(rock_radius[i], before[i]);
        } else {
            EXPECT_EQ(d.radius[i], before[i]);
            EXPECT_TRUE(d.material[i] == 3 || off >= 250.0 || on < 0.0) << d.x[i] << " " << d.y[i];
        }
    }
    EXPECT_GT(count, 50);
    const ConstContactColumns c = contact_columns(std::as_const(state));
    for (std::size_t k = 0; k < c.first.size(); ++k)
        if (d.material[static_cast<std::size_t>(c.first[k])] == weak ||
            d.material[static_cast<std::size_t>(c.second[k])] == weak) {
            EXPECT_FALSE(c.bonded[k]);
        }
    EXPECT_FALSE(OldFaults({}, 9.81).start(state, {}));
}

} // namespace
} // namespace listric::rock_layers_test
