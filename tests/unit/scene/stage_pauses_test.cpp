// Strain and displacement of rock since a pause began, and those of the newest once it is over.
// Made motions, exact up to round-off.

#include "apps/model/effects/stage/pauses.hpp"
#include "dem/events/strain.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace listric::pause_record_test {

using namespace dem;
using effects::stage::PauseRecord;
namespace {

using namespace support;

MotionStage moves(double start, double end) {
    return {.start = Travel(start), .end = Travel(end), .speed = 1.0};
}
MotionStage pause(double start, double end) {
    return {.start = Travel(start), .end = Travel(end), .slope = 0.0, .speed = 1.0};
}

struct Block {
    State state = make_state(cloud(12, 12, 50.0, 3));
    Strain windows{500.0, 0.01};
    PauseRecord record;

    explicit Block(std::vector<MotionStage> stages)
        : record({.speed = 1.0, .stages = std::move(stages)}) {
        windows.begin(state);
        record.begin(state);
    }

    /// Simple shear, by which what is highest moves furthest.
    void shear(double gamma) {
        const DiscColumns d = disc_columns(state);
        for (std::size_t i = 0; i < d.x.size(); ++i)
            d.x[i] += gamma * d.y[i];
    }
    void apply(Event& event) {
        event.apply(state, {});
        ++event.applied;
    }
};

TEST(PauseRecord, TellsStrainAndDisplacementOfThePauseAlone) {
    Block b({moves(0.0, 600.0), pause(600.0, 1000.0), moves(1000.0, 2000.0)});
    EXPECT_FALSE(b.record.unrest(b.state));
    b.shear(0.2);
    b.apply(b.windows); // at 500 m
    b.shear(0.05);      // of a window that is not over when the pause begins
    EXPECT_EQ(b.record.next_due().m, 600.0);
    b.apply(b.record);
    EXPECT_NEAR(b.record.unrest(b.state)->strain, 0.0, 1e-12);
    EXPECT_NEAR(b.record.strain_before(), 0.2, 1e-12);
    b.shear(0.1);
    const auto all = b.record.unrest(b.state);
    EXPECT_NEAR(all->strain, 0.1, 1e-12);
    const auto highest = std::ranges::max(disc_columns(b.state).y);
    EXPECT_NEAR(all->farthest, 0.1 * highest, 1e-9);
    double far = 0.0;
    for (const double y : disc_columns(b.state).y)
        far += std::abs(0.1 * y) > 100.0 ? 1.0 : 0.0;
    EXPECT_EQ(all->moved, far);
    EXPECT_EQ(b.record.next_due().m, 1000.0);
    b.apply(b.record);
    b.shear(0.5); // motion again
    EXPECT_EQ(b.record.unrest(b.state)->strain, all->strain);
    EXPECT_EQ(b.record.unrest(b.state)->farthest, all->farthest);
    EXPECT_EQ(b.record.next_due().m, std::numeric_limits<double>::infinity());
}

TEST(PauseRecord, SedimentIsNoneOfIt) {
    Block b({moves(0.0, 500.0), pause(500.0, 1000.0)});
    b.apply(b.windows);
    b.apply(b.record);
    const DiscColumns d = disc_columns(b.state);
    for (std::size_t i = 0; i < d.x.size(); i += 2)
        d.stratum[i] = 1;
    for (std::size_t i = 0; i < d.x.size(); i += 2)
        d.y[i] -= 200.0;
    EXPECT_EQ(b.record.unrest(b.state)->moved, 0.0);
    EXPECT_EQ(b.record.unrest(b.state)->farthest, 0.0);
}

TEST(PauseRecord, EveryPauseBeginsAnew) {
    Block b({pause(0.0, 100.0), pause(100.0, 200.0), moves(200.0, 300.0), pause(300.0, 400.0)});
    for (const double travel : {0.0, 200.0, 300.0}) { // two stages are one pause
        EXPECT_EQ(b.record.next_due().m, travel);
        b.apply(b.record);
        b.shear(0.3);
        if (travel == 200.0) {
            EXPECT_NEAR(b.record.unrest(b.state)->strain, 0.3, 1e-12);
        }
    }
    EXPECT_EQ(b.record.next_due().m, 400.0);
    EXPECT_EQ(b.record.strain_before(), 0.0);
}

TEST(PauseRecord, IsThereForPausesAlone) {
    EXPECT_FALSE(PauseRecord::is_needed({.speed = 1.0}));
    EXPECT_FALSE(PauseRecord::is_needed({.speed = 1.0, .stages = {moves(0.0, 1.0)}}));
    EXPECT_TRUE(PauseRecord::is_needed({.speed = 1.0, .stages = {pause(0.0, 1.0)}}));
}

/// Two steps of a pause. What rock does before the last quarter of a step is no unrest.
TEST(StepRecord, FindsStepsThatDoNotComeToRest) {
    State state = make_state(cloud(12, 12, 50.0, 3));
    effects::stage::StepRecord record(Calendar(0.01, {{Travel(100.0), Travel(200.0), 2, 1e6}}),
                                      false);
    record.begin(state);
    const DiscColumns d = disc_columns(state);
    d.stratum[0] = 1;
    const auto go = [&](double rock) {
        for (std::size_t i = 1; i < d.x.size(); ++i)
            d.y[i] -= rock * state.mean_radius;
        d.y[0] -= 1e3; // sediment falls
        record.apply(state, {});
        ++record.applied;
    };
    EXPECT_EQ(record.next_due().m, 250.0);
    go(1.0);
    EXPECT_EQ(record.next_due().m, 300.0);
    go(0.0099);
    EXPECT_NEAR(record.last(), 0.0099 * state.mean_radius, 1e-9);
    EXPECT_EQ(record.unsettled(), 0.0);
    go(1.0);
    go(0.0101);
    EXPECT_EQ(record.unsettled(), 1.0);
    EXPECT_EQ(record.steps(), 2.0);
    EXPECT_EQ(record.next_due().m, std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace listric::pause_record_test
