// Which past moments the history of faults is followed through.

#include "apps/archive/run_history.hpp"

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
