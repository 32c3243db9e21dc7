// Discs that overlap deeply have the energy K U^2 / 2 per contact and fly apart.
//   Known answer: two discs of mass m let go at an overlap U part with the relative velocity
//   U sqrt(2 K / m), here within the second order of the step.
// The remedy of genesis is to let discs grow where they are while they push each other apart,
// stopped again and again. Without it, discs of full size at random places fly away.

#include "dem/genesis/packing.hpp"
#include "tests/stability/hard_case.hpp"

namespace listric::deep_overlap_test {

using namespace dem;
namespace {

using namespace support;

constexpr double r = 93.1;

TEST(DeepOverlap, PairPartsWithItsEnergy) {
    for (double share : {0.1, 0.5, 0.9}) { // of the distance at contact
        const double overlap = share * 2.0 * r;
        State state = make_state({{0.0, 0.0, r}, {2.0 * r - overlap, 0.0, r}});
        const Material m;
        const double mass = disc_columns(state).mass[0];
        state.clock.time_step = stable_time_step(mass, m, 0.0, 0.1);
        find_contacts(state, {});
        advance_with_restart(state, {}, {0.0, 0.0}, 100);
        const DiscColumns d = disc_columns(state);
        const double parting = overlap * std::sqrt(2.0 * contact_stiffness(m) / mass);
        // (omega dt)^2 / 8 = 1e-3, and a step's change of velocity at the end.
        EXPECT_NEAR(d.vx[1] - d.vx[0], parting, 4e-3 * parting) << share;
        EXPECT_NEAR(d.vx[1] + d.vx[0], 0.0, 1e-12 * parting);
        EXPECT_EQ(d.vy[1], 0.0);
    }
}

TEST(DeepOverlap, TwoDiscsAtOnePlaceAreNotReturnedWithoutAPlace) {
    for (const Execution& how : {Execution{1, Cycle::plain}, Execution{1, fast_cycle()}})
        for (const std::int64_t cycles : {1, 100}) {
            State state = make_state({{0.0, 0.0, r}, {0.0, 0.0, r}});
            state.clock.time_step = 1e-3;
            find_contacts(state, {});
            EXPECT_THROW(advance(state, {}, {}, cycles, how), NumericalFailure) << cycles;
        }
}

/// A box that is open above, filled by genesis or at once.
struct Crowd {
    static constexpr double width = 20.0 * r, height = 20.0 * r;
    RigidBase base = box(width, 1e5);
    State state;

    explicit Crowd(bool remedy) {
        const std::vector<double> radius = draw_radii(radius_range(r, 1.66), 80, 3);
        state = make_state(std::vector<Disc>(radius.size(), {0.0, 0.0, r}));
        const DiscColumns d = disc_columns(state);
        state.clock.time_step =
            stable_time_step(0.56 * d.mass[0], state.materials[basement], 0.7, 0.95);
        if (remedy) {
            RigidBase closed = base;
            closed.surfaces.push_back({"lid", {line({1e5, height}, {-1e5, height})}});
            scatter_and_expand(state, closed, radius, width, 0.0, height, 0.7,
                               [](std::string_view, double) {});
        } else {
            Random random(4);
            for (std::size_t i = 0; i < d.x.size(); ++i) {
                d.radius[i] = radius[i];
                d.x[i] = random.between(r, width - r);
                d.y[i] = random.between(r, height - r);
            }
        }
        find_contacts(state, base);
    }

    /// Greatest height that a disc reaches in the next cycles, m.
    double highest(int cycles) {
        double top = 0.0;
        for (int n = 0; n < cycles; n += 500) {
            advance_with_restart(state, base, {0.7, 9.81}, 500);
            top = std::max(top, std::ranges::max(disc_columns(state).y));
        }
        return top;
    }
};

TEST(DeepOverlap, GrownDiscsSettle) {
    Crowd crowd(true);
    EXPECT_LT(crowd.highest(20000), 1.2 * Crowd::height);
    EXPECT_EQ(escaped(crowd.state, crowd.base), 0);
    EXPECT_LT(deepest(crowd.state), 0.02);
    EXPECT_LT(fastest(crowd.state), 0.1);
}

TEST(DeepOverlap, DiscsOfFullSizeAtOnceFlyAway) {
    Crowd crowd(false);
    EXPECT_GT(crowd.highest(4000), 3.0 * Crowd::height);
}

} // namespace
} // namespace listric::deep_overlap_test
