// Sedimentation fills up to the target with discs that touch without overlap, books their mass,
// and leaves what is full alone. Ground places discs to 1e-4 m; the fill's bulk density is that of
// the grains at surface porosity, to ten percent since a tenth of the discs touches a wall or the
// surface, where packing is looser.

#include "dem/events/sedimentation.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric {
namespace {

using namespace support;

constexpr double r = 93.1, width = 40.0 * r, depth = 30.0 * r;
constexpr double rate = 0.01; // m/a

struct Basin {
    RigidBase base = box(width, 1e5);
    State state = make_state(row(20, r));
    Sedimentation event;

    explicit Basin(double level = depth) : event({.level = level}, 1.66, rate) {
        for (double& x : disc_columns(state).x)
            x += r;
        for (double& y : disc_columns(state).y)
            y += r;
        state.clock.extension = 3.0 * event.schedule().spacing();
    }
};

TEST(Sedimentation, FillsToTheLevelWithoutOverlap) {
    Basin b;
    ASSERT_TRUE(b.event.apply(b.state, b.base));
    const DiscColumns d = disc_columns(b.state);
    const double smallest = 2.0 * r / 2.66, largest = 1.66 * smallest;
    std::vector<double> top(20, 0.0);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        int held_by = d.y[i] < d.radius[i] + 1e-3;
        for (std::size_t j = 0; j < d.x.size(); ++j) {
            if (j == i)
                continue;
            const double gap =
                std::hypot(d.x[j] - d.x[i], d.y[j] - d.y[i]) - d.radius[i] - d.radius[j];
            EXPECT_GE(gap, -1e-6 * r);
            held_by += gap < 1e-5 * r && d.y[j] < d.y[i];
        }
        EXPECT_GE(d.x[i], d.radius[i] - 1e-6 * r);
        EXPECT_LE(d.x[i], width - d.radius[i] + 1e-6 * r);
        if (d.stratum[i] == 0)
            continue;
        EXPECT_GE(held_by, 1);
        EXPECT_GE(d.radius[i], smallest);
        EXPECT_LE(d.radius[i], largest);
        EXPECT_LE(d.y[i] + d.radius[i], depth + 0.5 * smallest);
        auto& t = top[static_cast<std::size_t>(std::clamp(20.0 * d.x[i] / width, 0.0, 19.0))];
        t = std::max(t, d.y[i] + d.radius[i]);
    }
    for (double t : top)
        EXPECT_GT(t, depth - 2.0 * largest);
}

TEST(Sedimentation, RecordsTheNewDiscs) {
    Basin b;
    b.event.apply(b.state, b.base);
    const DiscColumns d = disc_columns(b.state);
    double deposited = 0.0;
    std::vector<std::int64_t> ids(d.id.begin(), d.id.end());
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        EXPECT_EQ(d.material[i], d.id[i] < 20 ? basement : sediment);
        EXPECT_EQ(d.stratum[i], d.id[i] < 20 ? 0 : 3);
        if (d.id[i] < 20)
            continue;
        EXPECT_EQ(d.start_x[i], d.x[i]);
        EXPECT_EQ(d.start_y[i], d.y[i]);
        EXPECT_EQ(d.start_extension[i], b.state.clock.extension);
        EXPECT_EQ(d.vx[i], 0.0);
        deposited += d.mass[i];
    }
    std::ranges::sort(ids);
    EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end());
    EXPECT_NEAR(b.state.ledger.deposited, deposited, 1e-12 * deposited);
    const double bulk = 2600.0 * 0.5 * width * (depth - 2.0 * r);
    EXPECT_NEAR(deposited, bulk, 0.1 * bulk);
}

TEST(Sedimentation, LeavesWhatIsFullAlone) {
    Basin b(r); // below the tops of the discs that are there
    const std::uint64_t before = hash(b.state);
    EXPECT_FALSE(b.event.apply(b.state, b.base));
    EXPECT_EQ(hash(b.state), before);
}

TEST(Sedimentation, SecondHelpingIsSmall) {
    Basin b;
    b.event.apply(b.state, b.base);
    const std::size_t filled = b.state.discs.rows();
    b.state.clock.extension += b.event.schedule().spacing();
    b.event.apply(b.state, b.base);
    EXPECT_LT(b.state.discs.rows() - filled, filled / 50);
}

TEST(Sedimentation, DependsOnTheSeedAlone) {
    Basin a, same, other;
    other.state.seed = 2;
    for (Basin* b : {&a, &same, &other})
        b->event.apply(b->state, b->base);
    EXPECT_EQ(hash(a.state), hash(same.state));
    other.state.seed = a.state.seed;
    EXPECT_NE(hash(a.state), hash(other.state));
}

} // namespace
} // namespace listric
