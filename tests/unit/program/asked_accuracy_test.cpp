// Levels that are asked for by time or by error, from recorded runs.

#include "apps/commands/asked_accuracy.hpp"
#include "apps/model/effects.hpp"
#include "apps/studies/sweep/student.hpp"
#include "apps/studies/sweep/sweep_effects.hpp"
#include "apps/support/error.hpp"
#include "tests/message_of.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace listric::asked_accuracy_test {

using archive::KnownError;
using archive::RecordedRun;
using testing::HasSubstr;
namespace {

std::string message(const std::function<void()>& call) {
    return support::message_of<UsageError>(call, "none");
}

TEST(AskedAccuracy, ReadsTimesWithTheirUnit) {
    EXPECT_EQ(parse_duration("--within", "90s"), 90.0);
    EXPECT_EQ(parse_duration("--within", "10min"), 600.0);
    EXPECT_EQ(parse_duration("--within", "1.5h"), 5400.0);
    EXPECT_EQ(parse_duration("--within", "2d"), 172800.0);
    for (const char* wrong : {"", "10", "min", "-1h", "0s", "1e300h", "nan s", "10 minutes"})
        EXPECT_THAT(message([&] { parse_duration("--within", wrong); }), HasSubstr("such as 90s"))
            << wrong;
}

TEST(AskedAccuracy, ReadsErrorsInTheMeasuresUnit) {
    const auto targets = parse_error_targets("tilt=0.1deg,cutoff=0.2km,area=3%,top10=0.05");
    ASSERT_EQ(targets.size(), 5u); // a cutoff has x and depth
    EXPECT_EQ(targets[0].key, "rollover_tilt_deg");
    EXPECT_EQ(targets[0].most, 0.1);
    EXPECT_EQ(targets[1].key, "cutoff_x_m");
    EXPECT_EQ(targets[2].key, "cutoff_z_m");
    EXPECT_EQ(targets[2].most, 200.0);
    EXPECT_TRUE(targets[3].is_share);
    EXPECT_NEAR(targets[3].most, 0.03, 1e-15);
    EXPECT_EQ(targets[4].key, "strain_top10");
    EXPECT_EQ(parse_error_targets("2%").size(), 4u);
    EXPECT_EQ(parse_error_targets("cutoff_x_m=50m")[0].most, 50.0);
}

TEST(AskedAccuracy, RefusesErrorsThatSayNothing) {
    EXPECT_THAT(message([] { parse_error_targets("tilr=1deg"); }), HasSubstr("did you mean tilt?"));
    EXPECT_THAT(message([] { parse_error_targets("tilt=1km"); }), HasSubstr("%, deg"));
    EXPECT_THAT(message([] { parse_error_targets("cutoff=0.2"); }), HasSubstr("%, km, m"));
    EXPECT_THAT(message([] { parse_error_targets("cutoff=-1km"); }), HasSubstr("above 0"));
    EXPECT_THAT(message([] { parse_error_targets("tilt"); }), HasSubstr("such as 2%"));
    EXPECT_THAT(message([] { parse_error_targets(""); }), HasSubstr("such as 2%"));
}

TEST(AskedAccuracy, PrintsTheCallThatWasAskedAbout) {
    const SceneRequest request{.scene = "lis1", .set = {"extension.distance_m=5000"}, .seed = 7};
    EXPECT_THAT(explain_asked({.within = "1d", .error = ""}, request, 1),
                HasSubstr(" --set extension.distance_m=5000 --set extension.speed_m_per_s="));
    EXPECT_THAT(explain_asked({.within = "1d", .error = ""}, request, 1),
                testing::ContainsRegex("speed_m_per_s=[0-9.]+ --seed 7\n"));
}

TEST(AskedAccuracy, RefusesWhatItChoosesItself) {
    for (const char* change : {"extension.speed_m_per_s=0.5", "hanging_wall.mean_radius_m=300"}) {
        SceneRequest request{.scene = "lis1", .set = {change}};
        EXPECT_THAT(message([&] { apply_asked({.within = "10min", .error = ""}, request, 1); }),
                    HasSubstr("--within and --error choose"));
    }
}

/// Draft is 0.3 off in 10 s, standard 0.1 in 100 s, both with a spread of 0.2 of nine seeds.
KnownError error_of(double resolution) {
    KnownError error{.key = "rollover_tilt_deg", .resolution = {}, .speed = {}, .spread = {}};
    error.resolution = archive::ErrorPart{resolution, 9, 0.0, "r", "a"};
    error.speed = archive::ErrorPart{-0.05, 9, 0.0, "r", "a"};
    error.spread = archive::ErrorPart{0.2, 9, 0.0, "r", "a"};
    error.mean = 40.0;
    return error;
}

const std::vector<AccuracyChoice> choices{{"draft", {1.25}, 1, 10.0, {error_of(0.3)}},
                                          {"standard", {1.0}, 1, 100.0, {error_of(-0.1)}}};

TEST(AskedAccuracy, PromisesWhatTheSpreadOfFewSeedsAllows) {
    for (const int seeds : {1, 4}) {
        const double expected =
            0.3 + 0.05 + student_quantile(0.9, 8.0) * 0.2 * std::sqrt(1.0 / seeds + 1.0 / 9.0);
        EXPECT_NEAR(*promised_error(error_of(0.3), seeds), expected, 1e-12);
    }
    for (auto part : {&KnownError::resolution, &KnownError::speed, &KnownError::spread}) {
        KnownError error = error_of(0.3);
        error.*part = std::nullopt;
        EXPECT_FALSE(promised_error(error, 1));
    }
}

TEST(AskedAccuracy, ChoosesTheLeastTimeForAnError) {
    const auto choice = [](double most, bool is_share = false) {
        const ErrorTarget target[]{{"rollover_tilt_deg", most, is_share}};
        return cheapest_choice(choices, target);
    };
    EXPECT_EQ(choice(0.8)->level, "draft");
    EXPECT_EQ(choice(0.8)->seeds, 1);
    // 0.35 + 1.86 * 0.2 * sqrt(1 / n + 1 / 9) is 0.557 for five seeds, 0.546 for six, which are
    // quicker than one at standard.
    EXPECT_EQ(choice(0.55)->level, "draft");
    EXPECT_EQ(choice(0.55)->seeds, 6);
    EXPECT_EQ(choice(0.55)->seconds, 60.0);
    EXPECT_EQ(choice(0.4)->level, "standard");
    EXPECT_EQ(choice(0.02, true)->level, "draft"); // 2 % of 40
    EXPECT_FALSE(choice(0.2));
}

TEST(AskedAccuracy, FillsATimeWithTheFinestLevel) {
    EXPECT_FALSE(best_choice(choices, 9.0));
    EXPECT_EQ(best_choice(choices, 35.0)->level, "draft");
    EXPECT_EQ(best_choice(choices, 35.0)->seeds, 3);
    EXPECT_EQ(best_choice(choices, 250.0)->level, "standard");
    EXPECT_EQ(best_choice(choices, 250.0)->seeds, 2);
    EXPECT_EQ(best_choice(choices, 1e9)->seeds, 10);
    // A slower speed of which nothing can be promised comes after one with a promise.
    std::vector<AccuracyChoice> slower{choices[0], choices[0]};
    slower[1].pace.speed = 0.5;
    EXPECT_EQ(best_choice(slower, 10.0)->pace.speed, 0.5);
    slower[1].errors[0].speed = std::nullopt;
    EXPECT_EQ(best_choice(slower, 10.0)->pace.speed, 1.25);
}

TEST(AskedAccuracy, KnowsTheRecordedWaysOfAScene) {
    std::vector<RecordedRun> runs(2, {.record = "r",
                                      .scene = "lis1",
                                      .made_by = "0",
                                      .mean_radius = 93.1,
                                      .pace = {1.0},
                                      .extension = 10e3,
                                      .seed = 1,
                                      .measures = {{"rollover_tilt_deg", 38.0}}});
    runs[1].scene = "rfr";
    const auto found = recorded_choices(runs, {.scene = "lis1"}, [](const Scene& scene) {
        EXPECT_EQ(scene.hanging_wall.mean_radius, 93.1);
        return 7.0;
    });
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].level, "standard");
    EXPECT_EQ(found[0].seconds, 7.0);
    // Nothing is recorded at half the extension.
    EXPECT_TRUE(recorded_choices(runs, {.scene = "lis1", .set = {"extension.distance_m=5000"}},
                                 [](const Scene&) { return 7.0; })
                    .empty());
}

TEST(AskedAccuracy, SaysWhereNothingIsRecorded) {
    const AskedAccuracy asked{.within = "1h", .error = ""};
    EXPECT_THAT(explain_asked(asked, {.scene = "pure-shear"}, 1),
                HasSubstr("no run of pure-shear to 2 km of extension is recorded"));
    EXPECT_THAT(explain_asked({.within = "", .error = "cutoff=0.01km"}, {.scene = "lis1"}, 1),
                testing::AllOf(HasSubstr("cutoff, depth "), testing::Not(HasSubstr("cutoff_z"))));
    SceneRequest request{.scene = "lis1", .set = {"fault_weakening.interval_a=40000"}};
    EXPECT_THAT(message([&] { apply_asked(asked, request, 1); }),
                HasSubstr("its fault_weakening.interval_a is not the one of the recorded runs"));
    request = {.scene = "lis1"};
    request.accuracy = "draft";
    EXPECT_THAT(message([&] { apply_asked(asked, request, 1); }), HasSubstr("--accuracy draft"));
}

} // namespace
} // namespace listric::asked_accuracy_test
