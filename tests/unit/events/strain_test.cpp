// Shear strain of simple shear is gamma, of rigid rotation second order in the angle, and a disc
// that was deposited in the window does not count for its neighbours, and figures know no strain of
// it.

#include "apps/figures/window_strain.hpp"
#include "dem/events/strain.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

namespace listric::strain_test {

using namespace dem;
namespace {

using namespace support;

State block() {
    State state = make_state(cloud(12, 12, 50.0, 3));
    Strain(500.0, 0.01).begin(state);
    return state;
}

TEST(Strain, SimpleShear) {
    State state = block();
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        d.x[i] += 0.1 * d.y[i];
    // A homogeneous gradient is fitted exactly, up to round-off.
    for (double gamma : shear_strain(state))
        EXPECT_NEAR(gamma, 0.1, 1e-12);
}

TEST(Strain, RotationIsNone) {
    State state = block();
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double x = d.x[i], y = d.y[i];
        d.x[i] = std::cos(0.033) * x - std::sin(0.033) * y;
        d.y[i] = std::sin(0.033) * x + std::cos(0.033) * y;
    }
    for (double gamma : shear_strain(state))
        EXPECT_NEAR(gamma, 0.0, 1e-12);
}

TEST(Strain, DepositedDiscsAreLeftOut) {
    State state = block();
    const std::size_t added = add_discs(state, 1);
    const DiscColumns d = disc_columns(state);
    d.x[added] = 300.0;
    d.y[added] = 1100.0;
    d.radius[added] = 50.0;
    for (double gamma : shear_strain(state))
        EXPECT_NEAR(gamma, 0.0, 1e-12);
}

TEST(Strain, FiguresKnowNoneOfSedimentThatCameSinceTheWindowBegan) {
    State state = block();
    Events events;
    events.push_back(std::make_unique<Strain>(500.0, 0.01));
    const std::size_t young = add_discs(state, 1);
    const DiscColumns d = disc_columns(state);
    d.x[young] = 300.0;
    d.y[young] = 1100.0;
    d.radius[young] = 50.0;
    d.stratum[young] = 1;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        d.x[i] += 0.1 * d.y[i];
    for (int window = 0; window < 2; ++window) { // before the end of the first, and after it
        const Scene scene;
        const ModelParts parts;
        const std::vector<double> strain = window_strain({scene, parts, state, events});
        EXPECT_TRUE(std::isnan(strain[young]));
        EXPECT_EQ(std::ranges::count_if(strain, [](double gamma) { return gamma > 0.05; }), 144);
        events.front()->apply(state, {});
        events.front()->applied = 1;
    }
}

TEST(Strain, AddsUpWindows) {
    State state = block();
    Strain strain(500.0, 0.01);
    for (int window = 0; window < 2; ++window) {
        const DiscColumns d = disc_columns(state);
        for (std::size_t i = 0; i < d.x.size(); ++i)
            d.x[i] += 0.1 * d.y[i];
        strain.apply(state, {});
    }
    EXPECT_NEAR(state.discs.get<double>("window_strain")[70], 0.1, 1e-12);
    EXPECT_NEAR(state.discs.get<double>("total_strain")[70], 0.2, 1e-12);
}

/// A block whose discs have lost pores, the more the higher they are, and sunk by it.
State sunk_block() {
    constexpr double height = 1100.0;
    State state = make_state(cloud(12, 12, 50.0, 3));
    state.discs.add<double>("porosity", "1", 0.5);
    Strain(500.0, 0.01).begin(state);
    const DiscColumns d = disc_columns(state);
    const auto porosity = state.discs.get<double>("porosity");
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        // Strain -0.1 y / h of the height before: (porosity - 0.5) / (1 - porosity).
        const double strain = -0.1 * d.y[i] / height;
        porosity[i] = (0.5 + strain) / (1.0 + strain);
        d.y[i] -= 0.05 * d.y[i] * d.y[i] / height; // the sum of the strain below
    }
    return state;
}

// The strain is linear in height, of which the mean of two discs' is exact, up to round-off.
TEST(Strain, CompactionIsNoTectonicStrain) {
    const State state = sunk_block();
    EXPECT_GT(std::ranges::max(shear_strain(state)), 0.07);
    const auto tectonic = tectonic_strain(state);
    for (const double gamma : tectonic.value())
        EXPECT_NEAR(gamma, 0.0, 1e-12);
}

TEST(Strain, WhatShearsBesidesCompactionIsTectonic) {
    State state = sunk_block();
    Strain strain(500.0, 0.01);
    const DiscColumns d = disc_columns(state);
    const auto old_y = state.discs.get<double>("window_y");
    for (std::size_t i = 0; i < d.x.size(); ++i)
        d.x[i] += 0.1 * old_y[i];
    strain.apply(state, {});
    const auto window = state.discs.get<double>("window_tectonic_strain");
    const auto total = state.discs.get<double>("total_tectonic_strain");
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        EXPECT_NEAR(window[i], 0.1, 1e-12);
        EXPECT_EQ(total[i], window[i]);
    }
    EXPECT_GT(std::ranges::max(state.discs.get<double>("window_strain")), 0.11);
    // The next window begins with the porosity that there is.
    const auto tectonic = tectonic_strain(state);
    for (const double gamma : tectonic.value())
        EXPECT_NEAR(gamma, 0.0, 1e-12);
}

TEST(Strain, IsAllTectonicWhereNothingCompacts) {
    State state = block();
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        d.x[i] += 0.1 * d.y[i];
    EXPECT_EQ(*tectonic_strain(state), shear_strain(state));
    Strain(500.0, 0.01).apply(state, {});
    for (const char* span : {"window", "total"})
        EXPECT_TRUE(
            std::ranges::equal(state.discs.get<double>(std::string(span) + "_strain"),
                               state.discs.get<double>(std::string(span) + "_tectonic_strain")));
}

// A run that an older program began has no porosity of the window's beginning: until the next one
// nothing is said, rather than something wrong.
TEST(Strain, SaysNothingOfAWindowThatAnOlderProgramBegan) {
    State state = sunk_block();
    for (const char* name : {"window_porosity", "window_tectonic_strain", "total_tectonic_strain"})
        state.discs.remove(name);
    Strain strain(500.0, 0.01);
    EXPECT_FALSE(tectonic_strain(state));
    strain.apply(state, {});
    EXPECT_FALSE(state.discs.has("window_tectonic_strain"));
    strain.apply(state, {});
    EXPECT_TRUE(state.discs.has("window_tectonic_strain"));
    EXPECT_FALSE(state.discs.has("total_tectonic_strain"));
}

TEST(Strain, ItsNotesChangeNoHash) {
    State state = sunk_block();
    State without = state;
    for (const char* name : {"window_porosity", "window_tectonic_strain", "total_tectonic_strain"})
        without.discs.remove(name);
    EXPECT_EQ(hash(state), hash(without));
    EXPECT_NE(hash(state, Notes::counted), hash(without, Notes::counted));
}

} // namespace
} // namespace listric::strain_test
