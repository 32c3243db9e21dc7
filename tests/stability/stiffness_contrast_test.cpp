// Stiff discs between soft ones. Two springs in series are as soft as the softer one, so a contrast
// makes no contact stiffer than those of the stiff discs among themselves: the time step is that of
// the stiffest material.
//   Known answer: a row of n discs, soft and stiff in turn, squeezed by c between two walls of the
//   stiff material carries N = c / sum(1 / K), with K of every contact.
// The remedy: the least of the materials' time steps. Without it, that of the softest.

#include "dem/genesis/genesis.hpp"
#include "tests/stability/hard_case.hpp"

namespace listric::stiffness_contrast_test {

using namespace dem;
namespace {

using namespace support;

constexpr double r = 93.1;

class StiffnessContrast : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(Of, StiffnessContrast, testing::Values(200.0, 1e4));

Material softer(const Material& m, double contrast) {
    return {m.normal_stiffness / contrast, m.shear_stiffness / contrast, m.friction, m.bondable};
}

double time_step(const Material& stiff, const Material& soft, bool remedy) {
    const double mass = density * pi * r * r;
    const Material both[] = {stiff, soft};
    return remedy ? stable_time_step(mass, both, 0.7, 0.95)
                  : stable_time_step(mass, soft, 0.7, 0.95);
}

struct Row {
    State state;
    RigidBase base;
    double force; ///< that every contact must carry, N

    Row(double contrast, bool remedy) {
        constexpr std::size_t n = 9;
        const Material stiff, soft = softer(stiff, contrast);
        const double squeeze = 0.02 * r;
        std::vector<Disc> discs = row(n, r);
        for (Disc& disc : discs)
            disc.x += r;
        state = make_state(discs, stiff);
        state.materials[weak] = soft;
        const DiscColumns d = disc_columns(state);
        for (std::size_t i = 0; i < n; i += 2)
            d.material[i] = weak;
        const double width = 2.0 * r * static_cast<double>(n) - squeeze;
        base.surfaces = {{"left", {line({0.0, 1e4}, {0.0, -1e4})}},
                         {"right", {line({width, -1e4}, {width, 1e4})}}};
        base.material = stiff;
        const auto series = [](double a, double b) { return a * b / (a + b); };
        // Every contact and both walls join a stiff and a soft one.
        force = squeeze * series(stiff.normal_stiffness, soft.normal_stiffness) /
                static_cast<double>(n + 1);
        state.clock.time_step = time_step(stiff, soft, remedy);
        find_contacts(state, base);
    }
};

TEST_P(StiffnessContrast, RowCarriesWhatSpringsInSeriesDo) {
    Row row(GetParam(), true);
    // The slowest mode takes 2 n sqrt(contrast) steps of the stiff material; damping of 0.7 halves
    // its amplitude several times a period.
    const auto cycles = static_cast<std::int64_t>(3000.0 * std::sqrt(GetParam()));
    advance_with_restart(row.state, row.base, {0.7, 0.0}, cycles);
    const std::vector<SurfaceLoad> loads = surface_loads(row.state, row.base);
    EXPECT_NEAR(loads[0].force.x, row.force, 1e-6 * row.force);
    EXPECT_NEAR(loads[1].force.x, -row.force, 1e-6 * row.force);
}

/// A heap of both kinds, in columns, thrown against the sides of a box without losses.
struct Mixture {
    State state;
    RigidBase base = box(26.0 * r, 1e5);

    Mixture(double contrast, bool remedy) {
        const Material stiff, soft = softer(stiff, contrast);
        std::vector<Disc> discs = hexagonal(12, 12, r);
        for (Disc& disc : discs) {
            disc.x += r;
            disc.y += r;
        }
        state = make_state(discs, stiff);
        state.materials[weak] = soft;
        const DiscColumns d = disc_columns(state);
        Random random(11);
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            if (i / 3 % 2)
                d.material[i] = weak;
            d.vx[i] = random.between(-0.1, 0.1);
            d.vy[i] = random.between(-0.1, 0.1);
        }
        state.clock.time_step = time_step(stiff, soft, remedy);
        bond_all(state, base);
        base.material = stiff;
    }
};

TEST_P(StiffnessContrast, MixtureStaysBounded) {
    // Without losses no disc can have more than all of the energy: 0.1 m/s of 144 discs.
    Mixture mixture(GetParam(), true);
    advance_with_restart(mixture.state, mixture.base, {0.0, 0.0}, 10000);
    EXPECT_LT(fastest(mixture.state), 0.1 * std::sqrt(144.0));
    EXPECT_EQ(escaped(mixture.state, mixture.base), 0);
}

TEST_P(StiffnessContrast, DivergesWithTheTimeStepOfTheSofter) {
    Mixture mixture(GetParam(), false);
    EXPECT_THROW(advance(mixture.state, mixture.base, {0.0, 0.0}, 10000), NumericalFailure);
}

} // namespace
} // namespace listric::stiffness_contrast_test
