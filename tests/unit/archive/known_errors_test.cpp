// Errors of results by recorded runs.

#include "apps/archive/error_sentence.hpp"
#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/known_errors.hpp"
#include "apps/archive/tables/dictionary.hpp"
#include "apps/model/effects.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "tests/message_of.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace listric::known_errors_test {

using namespace archive;
using testing::HasSubstr;
namespace {

const std::string tilt = "rollover_tilt_deg";

RecordedRun run_of(double radius, Pace pace, int seed, double value, const char* record = "r") {
    return {.record = record,
            .scene = "lis1",
            .made_by = "0",
            .mean_radius = radius,
            .pace = pace,
            .extension = 10e3,
            .seed = seed,
            .measures = {{tilt, value}}};
}

const std::vector<RecordedRun> runs{
    run_of(186.2, {1.25}, 1, 38.0), run_of(186.2, {1.25}, 2, 38.2), run_of(186.2, {1.25}, 3, 38.4),
    run_of(186.2, {0.5}, 1, 38.1, "slow"), run_of(93.1, {1.0}, 1, 38.5, "fine")};

KnownError error_at(double radius, Pace pace, double extension = 10e3) {
    const auto errors = known_errors(runs, {"lis1", radius, pace, extension});
    return *std::ranges::find(errors, tilt, &KnownError::key);
}

Scene draft(const std::vector<std::string>& set = {}) {
    SceneRequest request{.scene = "lis1", .set = set};
    request.accuracy = "draft";
    return load_scene(request);
}

TEST(KnownErrors, AreDistancesFromFinestAndSlowestAndTheSpreadBetweenSeeds) {
    const KnownError error = error_at(186.2, {1.25});
    EXPECT_NEAR(error.resolution->value, 38.2 - 38.5, 1e-12);
    EXPECT_EQ(error.resolution->record, "fine, r");
    EXPECT_EQ(error.resolution->against, "mean radius 93.1 m");
    EXPECT_NEAR(error.speed->value, 38.2 - 38.1, 1e-12);
    EXPECT_EQ(error.speed->record, "r, slow");
    EXPECT_NEAR(error.spread->value, 0.2, 1e-12);
    EXPECT_EQ(error.spread->runs, 3);
    EXPECT_NEAR(error.mean, 38.2, 1e-12);
}

TEST(KnownErrors, OfSoftDiscsAreDistancesFromStiffOnes) {
    std::vector<RecordedRun> soft = runs;
    soft.push_back(run_of(186.2, {2.0, 600.0, 4.0}, 1, 38.7, "soft"));
    soft.push_back(run_of(186.2, {1.25, 24.0, 4.0}, 1, 38.9, "soft, slow"));
    const auto at = [&](Pace pace) {
        const auto errors = known_errors(soft, {"lis1", 186.2, pace, 10e3});
        return *std::ranges::find(errors, tilt, &KnownError::key);
    };
    const KnownError error = at({2.0, 600.0, 4.0});
    EXPECT_NEAR(error.speed->value, 38.7 - 38.1, 1e-12);
    EXPECT_EQ(error.speed->against, "softness 4 against 1, 2 against 0.5 m/s, mean radius 186.2 m");
    EXPECT_EQ(error.mean, 38.7);
    EXPECT_EQ(at({1.25, 24.0, 4.0}).mean, 38.9);
    EXPECT_EQ(at({2.0, 24.0, 4.0}).mean, 0.0);                // another start
    EXPECT_NEAR(at({1.25}).speed->value, 38.2 - 38.1, 1e-12); // soft ones are no measure of stiff
}

TEST(KnownErrors, AreUnknownWithoutRuns) {
    const KnownError finest = error_at(93.1, {1.0});
    EXPECT_FALSE(finest.resolution); // nothing finer
    EXPECT_FALSE(finest.spread);     // one seed
    EXPECT_EQ(finest.speed->mean_radius, 186.2);
    EXPECT_FALSE(error_at(186.2, {0.5}).speed); // nothing slower
    for (const KnownError& none : {error_at(186.2, {1.25}, 5e3), error_at(46.55, {0.4})})
        EXPECT_FALSE(none.resolution || none.speed || none.spread);
}

TEST(KnownErrors, HoldForTheShippedSceneAlone) {
    EXPECT_EQ(departs_from_record(draft()), "");
    EXPECT_EQ(departs_from_record(draft({"extension.speed_m_per_s=2", "seed=7"})), "");
    EXPECT_EQ(departs_from_record(draft({"fault_weakening.interval_a=40000"})),
              "fault_weakening.interval_a");
    Scene own = draft();
    own.name = "own";
    EXPECT_EQ(departs_from_record(own), "name");
}

TEST(KnownErrors, AreInTheSummaryOfEveryRun) {
    const JsonObject of_lis1 = known_errors_json(draft(), 10e3);
    const JsonObject of_changed =
        known_errors_json(draft({"fault_weakening.interval_a=40000"}), 10e3);
    ASSERT_EQ(of_lis1.size(), 12u);
    ASSERT_EQ(of_changed.size(), 12u);
    EXPECT_TRUE(of_lis1[0]["spread"].is_number());
    EXPECT_EQ(known_errors_json(draft(), 300.0)[0]["spread"], "unknown"); // it ended early
    for (const JsonObject& one : of_changed)
        for (const char* part : {"resolution", "speed", "spread"})
            EXPECT_EQ(one[part], "unknown");
    EXPECT_THAT(error_sentence({{"known_errors", of_lis1}}), HasSubstr("tilt of the head block: "));
    EXPECT_THAT(error_sentence({{"known_errors", of_changed}}), HasSubstr("unknown"));
    EXPECT_EQ(error_sentence(JsonObject::object()), ""); // an older summary
}

TEST(KnownErrors, HeadlineMeasuresAndFieldsAreDeclared) {
    const auto entries = dictionary(program_effects());
    for (const HeadlineMeasure& measure : headline_measures())
        EXPECT_TRUE(std::ranges::any_of(entries, [&](const DictionaryEntry& entry) {
            return entry.quantity.name == measure.key && entry.at_end;
        })) << measure.key;
    for (const JsonObject& one : known_errors_json(draft(), 10e3))
        for (const auto& [name, value] : one.items())
            EXPECT_TRUE(std::ranges::count(error_fields(), name, &Quantity::name)) << name;
}

TEST(RunRecords, ShippedOnesAreOfShippedScenes) {
    const auto all = recorded_runs();
    EXPECT_GT(all.size(), 40u);
    std::vector<std::string> shipped;
    for (const auto& [name, description] : list_scenes())
        shipped.push_back(name);
    for (const RecordedRun& run : all) {
        const std::string scene = run.scene.substr(0, run.scene.find(" without "));
        EXPECT_THAT(shipped, testing::Contains(scene));
        EXPECT_FALSE(run.measures.empty());
    }
}

std::filesystem::path file_of_test() {
    return std::filesystem::path(testing::TempDir()) / fmt::format("listric-runs-{}.csv", getpid());
}

TEST(RunRecords, AreReadAsTheyWereWritten) {
    const auto file = file_of_test();
    write_run_records(file, runs);
    const auto read = read_run_records(file);
    ASSERT_EQ(read.size(), runs.size());
    for (std::size_t k = 0; k < runs.size(); ++k) {
        EXPECT_EQ(read[k].record, runs[k].record);
        EXPECT_EQ(read[k].pace.speed, runs[k].pace.speed);
        EXPECT_EQ(read[k].seed, runs[k].seed);
        EXPECT_EQ(read[k].measures, runs[k].measures);
    }
}

TEST(RunRecords, ThatAreDamagedAreRefusedWithTheirLine) {
    const auto file = file_of_test();
    const auto message = [&](const std::string& text) {
        write_text(file, text);
        return support::message_of<StorageError>([&] { read_run_records(file); }, "none");
    };
    const std::string head =
        "record,scene,made_by,mean_radius_m,speed_m_per_s,ramp_s,softness,extension_m,seed";
    EXPECT_THAT(message(head + ",tilt\n"), HasSubstr(":1: tilt is no column"));
    EXPECT_THAT(message("record,scene\n"), HasSubstr(":1: has no column"));
    EXPECT_THAT(message(head + "\nr,lis1,0,93,1,24,1,1e4,x\n"),
                HasSubstr(":2: seed: \"x\" is not"));
    EXPECT_THAT(message(head + "\nr,lis1,0,93\n"), HasSubstr(":2: has another number"));
    EXPECT_EQ(message(head + "\n"), "none");
}

} // namespace
} // namespace listric::known_errors_test
