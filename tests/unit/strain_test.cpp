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

} // namespace
} // namespace listric::strain_test
