// Which past moments the history of faults is followed through.

#include "apps/archive/folder/run_history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>

namespace listric::archive::run_history_test {
namespace {

using measures::DiscPlaces;

using testing::ElementsAre;
using testing::IsEmpty;

DiscPlaces places_at(double extension) {
    dem::State state = dem::empty_state();
    state.clock.travel.m = state.clock.extension.m = extension;
    return DiscPlaces(state);
}

RunHistory history_of(std::initializer_list<double> extensions) {
    RunHistory history;
    for (const double extension : extensions)
        history.add(places_at(extension));
    return history;
}

std::vector<double> before(const RunHistory& history, double extension) {
    measures::Setting setting;
    setting.output_interval = 100.0; // windows of at least 75 m
    std::vector<double> found;
    for (const DiscPlaces& places : history.before(dem::Travel(extension), setting))
        found.push_back(places.extension.m);
    return found;
}

TEST(RunHistory, MomentsBeforeOldestFirst) {
    const RunHistory history = history_of({0.0, 100.0, 200.0, 300.0});
    EXPECT_THAT(before(history, 300.0), ElementsAre(0.0, 100.0, 200.0));
    EXPECT_THAT(before(history, 200.0), ElementsAre(0.0, 100.0));
    EXPECT_THAT(before(history, 0.0), IsEmpty());
}

// Counted back from the present: what lies too close before a kept moment is passed over.
TEST(RunHistory, ExtraMomentsOfAStoppedRunMakeNoWindowShort) {
    const RunHistory history = history_of({0.0, 100.0, 160.0, 200.0});
    EXPECT_THAT(before(history, 300.0), ElementsAre(0.0, 100.0, 200.0));
    EXPECT_THAT(before(history, 200.0), ElementsAre(0.0, 100.0));
}

// Where the wall rests no window ends, and where it is slow a window takes more moments; the faults
// of a pause are those of the last way before it.
TEST(RunHistory, WindowsGoByTheWallsWay) {
    measures::Setting setting;
    setting.output_interval = 100.0;
    setting.motion.stages = {{.end = dem::Travel(200.0)},
                             {.start = dem::Travel(200.0),
                              .end = dem::Travel(500.0),
                              .start_position = dem::Extension(200.0),
                              .slope = 0.0},
                             {.start = dem::Travel(500.0),
                              .end = dem::Travel(900.0),
                              .start_position = dem::Extension(200.0),
                              .slope = 0.5},
                             {.start = dem::Travel(900.0),
                              .end = dem::Travel(1100.0),
                              .start_position = dem::Extension(400.0),
                              .slope = -1.0}};
    RunHistory history;
    for (double travel = 0.0; travel <= 1100.0; travel += 100.0) {
        dem::State state = dem::empty_state();
        state.clock.travel = dem::Travel(travel);
        state.clock.extension = setting.motion.position(state.clock.travel);
        history.add(DiscPlaces(state));
    }
    const auto before = [&](double travel) {
        std::vector<double> found;
        for (const DiscPlaces& places : history.before(dem::Travel(travel), setting))
            found.push_back(places.travel.m);
        return found;
    };
    EXPECT_THAT(before(200.0), ElementsAre(0.0, 100.0));
    EXPECT_THAT(before(400.0), ElementsAre(0.0, 100.0)); // in the pause
    EXPECT_THAT(before(900.0), ElementsAre(0.0, 100.0, 500.0, 700.0));
    EXPECT_THAT(before(1100.0), ElementsAre(0.0, 100.0, 500.0, 700.0, 900.0, 1000.0));
}

TEST(RunHistory, AResumedRunForgetsWhatLiesAhead) {
    RunHistory history = history_of({0.0, 100.0, 200.0, 300.0});
    history.add(places_at(200.0));
    EXPECT_THAT(before(history, 400.0), ElementsAre(0.0, 100.0, 200.0));
}

TEST(RunHistory, SnapshotsThatCannotBeReadArePassedOver) {
    const std::filesystem::path missing = "no-such-folder/extension-00000.00m.h5";
    EXPECT_THAT(before(RunHistory({&missing, 1}), 100.0), IsEmpty());
}

} // namespace
} // namespace listric::archive::run_history_test
