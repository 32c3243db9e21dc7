// `listric validate` on a scene of a few hundred discs: it makes the runs, resumes where it was
// stopped, measures and writes.

#include "apps/archive/folder/output_folder.hpp"
#include "apps/support/version.hpp"
#include "tests/places.hpp"
#include "tests/small_halfgraben.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace listric::validation_test {
namespace {

namespace fs = std::filesystem;
using listric::support::contents;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string scene = listric::support::small_halfgraben() + R"([extension]
distance_m = 200.0
speed_m_per_s = 4.0
ramp_s = 2.0
[output]
interval_m = 50.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
[fault_weakening]
interval_a = 6000.0
youngest_sediment_a = 5000.0
[bond_healing]
[sedimentation]
interval_a = 6000.0
[compaction]
)";

const std::string plan = R"([[run]]
name = "tiny"
scene = "tiny"
at_m = [100, 200]
[[run]]
name = "plain"
scene = "tiny"
without = "fault_weakening bond_healing"
seeds = 1
at_m = [200]
[[experiment]]
name = "first"
title = "First"
runs = "tiny plain"
compare = "plain"
expect = [
    {kind = "kinematics", measure = "extension_m", what = "reached", digits = 0, expected = 200, tolerance = 1, source = "scene"},
    {kind = "kinematics", measure = "extension_m", what = "gone since", since_m = 100, digits = 0, expected = 150, tolerance = 1, source = "nobody"},
    {measure = "weak_fraction", what = "weakened without weakening", run = "plain", least = 0.5, words = "never", source = "nobody"},
    {kind = "conservation", measure = "mass_error_fraction", what = "mass", digits = 3, most = 1e-12, source = "round-off"},
]
dropped = [{what = "reached once", reason = "nobody asks"}]
picture = [{name = "all", caption = "All.", rows = [{run = "tiny", at_m = 200}]}]
[[experiment]]
name = "second"
title = "Second"
runs = "plain"
expect = [
    {measure = "extension_m", what = "reached", least = 1, source = "scene"},
    {kind = "kinematics", measure = "extension_m", over = "extension_m", what = "of itself", expected = 1, source = "division"},
    {kind = "kinematics", measure = "extension_m", over = "eroded_fraction", what = "of nothing", expected = 1, source = "none is eroded"},
]
[[experiment]]
name = "alike"
title = "Alike"
runs = "plain"
like = "first"
)";

class ValidationTest : public testing::Test {
protected:
    fs::path folder =
        fs::temp_directory_path() / ("validation-" + std::to_string(getpid()) + "-" +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
    ValidationTest() {
        fs::create_directories(folder / "scenes");
        std::ofstream(folder / "scenes/tiny.toml") << scene;
        std::ofstream(folder / "plan.toml") << plan;
    }
    ~ValidationTest() override { fs::remove_all(folder); }

    /// Exit code of `listric validate` with these arguments; what it says is in `said`.
    int validate(const std::string& arguments) {
        const std::string line =
            "LISTRIC_SCENES=" + (folder / "scenes").string() + " '" + program_path + "' validate " +
            "--plan " + (folder / "plan.toml").string() + " --runs " + (folder / "runs").string() +
            " --output " + (folder / "doc/report.md").string() + " " + arguments + " 2> " +
            (folder / "said").string();
        const int code = WEXITSTATUS(std::system(line.c_str()));
        said = contents(folder / "said");
        return code;
    }
    std::string record() { return contents(folder / "doc/report/measures.csv"); }
    /// Writes measures.csv with those lines alone.
    void keep_lines(const std::function<bool(const std::string&)>& kept) {
        std::istringstream lines(record());
        std::ofstream out(folder / "doc/report/measures.csv");
        for (std::string line; std::getline(lines, line);)
            if (kept(line))
                out << line << '\n';
    }
    void replace_in_record(const std::string& from, const std::string& to) {
        std::string text = record();
        ASSERT_NE(text.find(from), text.npos) << from;
        text.replace(text.find(from), from.size(), to);
        std::ofstream(folder / "doc/report/measures.csv") << text;
    }
    std::string document() { return contents(folder / "doc/report.md"); }
    std::string said;
};

TEST_F(ValidationTest, RunsMeasuresJudgesAndKeeps) {
    ASSERT_EQ(validate("--seeds 2"), 0) << said;
    EXPECT_THAT(document(), AllOf(HasSubstr("3 of 3 runs"), HasSubstr("## First"),
                                  HasSubstr("## Second"), HasSubstr("![all](report/all.png)")));
    // Two seeds that reached 200 m, and cannot have gone 150 m since 100.
    EXPECT_THAT(
        document(),
        HasSubstr("| 200 ± 1 | scene | 200 ± 0 (200 to 200) | 200: 1 of 1 | met (2 of 2) |"));
    EXPECT_THAT(document(),
                HasSubstr("| 150 ± 1 | nobody | 100 ± 0 (100 to 100) |  | missed (0 of "));
    EXPECT_THAT(document(),
                HasSubstr("| at least 0.50 | “never” (nobody) | no value |  | no case |"));
    EXPECT_THAT(document(), HasSubstr("| First | 2 of 2 | 0 | 0 | 0 | 1 | 1 of 2 | 1 of 1 |"));
    // Beside each other by what both expect; the control is nothing that the second has.
    EXPECT_THAT(document(), AllOf(HasSubstr("| expected | first | alike |"),
                                  HasSubstr("| 200 ± 1 | met (2 of 2) | met (1 of 1) |"),
                                  HasSubstr("| 150 ± 1 | missed (0 of 2) |  |"),
                                  HasSubstr("| at least 0.50 | no case |  |")));
    EXPECT_THAT(document(), HasSubstr("| reached once | dropped | nobody asks |"));
    EXPECT_THAT(document(),
                AllOf(HasSubstr("| of itself (`extension_m` over `extension_m`) | 1.00 ± 0.00 | "
                                "division | 1.00 | met (1 of 1) |"),
                      HasSubstr("| of nothing (`extension_m` over `eroded_fraction`) | 1.00 ± 0.00 "
                                "| none is eroded | no value | no case |")));
    EXPECT_THAT(document(), HasSubstr("![criteria of faulting by experiment and seed]"));
    EXPECT_TRUE(fs::exists(folder / "doc/report/verdicts.png"));
    const std::string maker(listric::version);
    EXPECT_THAT(document(),
                HasSubstr("The runs were made by Listric " + maker + ", their measures taken by " +
                          maker + " (definitions " + std::string(listric::measures_hash) + ")."));
    EXPECT_TRUE(fs::exists(folder / "doc/report/all.png"));
    const auto hash = [&](const char* run) {
        return nlohmann::json::parse(contents(folder / "runs" / run / "summary.json"))["state_hash"]
            .get<std::string>();
    };
    EXPECT_THAT(contents(folder / "doc/report/measures.csv"),
                AllOf(HasSubstr("tiny,1,100," + hash("tiny-1")),
                      HasSubstr("tiny,2,200," + hash("tiny-2")),
                      HasSubstr("plain,1,200," + hash("plain-1"))));

    // Again: nothing is run or measured, and the document is the same.
    const std::string before = document();
    const auto made = fs::last_write_time(folder / "runs/tiny-1/summary.json");
    ASSERT_EQ(validate("--seeds 2"), 0) << said;
    EXPECT_EQ(document(), before);
    EXPECT_EQ(fs::last_write_time(folder / "runs/tiny-1/summary.json"), made);
    EXPECT_THAT(said, Not(HasSubstr("measuring")));
    ASSERT_EQ(validate("--seeds 2 --remeasure"), 0) << said;
    EXPECT_THAT(said, AllOf(HasSubstr("measuring"), HasSubstr("tiny-2")));
    EXPECT_EQ(document(), before);

    // A run that was stopped goes on, to the same end.
    const std::string end = hash("tiny-2");
    fs::remove(folder / "runs/tiny-2/summary.json");
    keep_lines([](const std::string& line) { return !line.starts_with("tiny,2,"); });
    ASSERT_EQ(validate("--seeds 2 --without-runs"), 0) << said;
    EXPECT_THAT(document(), AllOf(HasSubstr("2 of 3 runs"), HasSubstr("not recorded: tiny 2.")));
    ASSERT_EQ(validate("--seeds 2"), 0) << said;
    EXPECT_THAT(contents(folder / "runs/tiny-2/log.txt"), HasSubstr("resuming"));
    EXPECT_EQ(hash("tiny-2"), end);
    EXPECT_EQ(document(), before);

    // Runs of another accuracy are no runs of this one.
    EXPECT_EQ(validate("--seeds 1 --accuracy draft"), 2);
    EXPECT_THAT(said,
                AllOf(HasSubstr("plain-1"), HasSubstr("than the plan has at accuracy draft")));
}

TEST_F(ValidationTest, CriteriaThatTheControlMeetsAreCounted) {
    std::string text = plan;
    text.replace(text.find("seeds = 1\n"), 10, "");
    text.replace(text.find("expect = [\n"), 11,
                 "expect = [\n    {measure = \"extension_m\", what = \"gone\", "
                 "least = 1, words = \"extension\"},\n");
    std::ofstream(folder / "plan.toml") << text;
    ASSERT_EQ(validate("--seeds 1 --only first"), 0) << said;
    EXPECT_THAT(document(), Not(HasSubstr("shows, too")));

    // Four more seeds of the same numbers.
    std::istringstream lines(record());
    std::ofstream more(folder / "doc/report/measures.csv", std::ios::app);
    for (std::string line; std::getline(lines, line);)
        if (const auto seed = line.find(",1,"); seed != line.npos && line[0] != 'r')
            for (const char* other : {",2,", ",3,", ",4,", ",5,"})
                more << line.substr(0, seed) << other << line.substr(seed + 3) << '\n';
    more.close();
    ASSERT_EQ(validate("--seeds 5 --only first --without-runs --mixed"), 0) << said;
    EXPECT_THAT(document(), HasSubstr("1 of those shown `plain` shows, too (5 of 5 seeds)."));
    EXPECT_THAT(document(),
                HasSubstr("| 199.98 ± 0.00 (199.98 to 199.98): 5 of 5 | shown (5 of 5"));
    EXPECT_THAT(contents(folder / "doc/report/verdicts.json"), HasSubstr(R"("beside": "5 of 5")"));
}

TEST_F(ValidationTest, OneExperimentAlone) {
    ASSERT_EQ(validate("--seeds 1 --only second"), 0) << said;
    EXPECT_THAT(document(), AllOf(HasSubstr("## Second"), Not(HasSubstr("## First"))));
    EXPECT_FALSE(fs::exists(folder / "runs/tiny-1"));
}

TEST_F(ValidationTest, ALaterSessionAddsSeeds) {
    std::ofstream(folder / "plan.toml") << "seeds = \"1-3\"\n" + plan;
    ASSERT_EQ(validate("--seeds 1-2 --only first"), 0) << said;
    EXPECT_THAT(document(), AllOf(HasSubstr("3 of 4 runs"), HasSubstr("| First | 2 of 3 |"),
                                  HasSubstr("not recorded: tiny 3.")));
    const std::string before = record();

    // Another machine has the record and no runs.
    fs::remove_all(folder / "runs");
    ASSERT_EQ(validate("--seeds 3 --first-seed 1 --without-runs"), 0) << said;
    EXPECT_EQ(record(), before);
    std::ofstream(folder / "plan.toml") << "seeds = \"2-3\"\n" + plan;
    ASSERT_EQ(validate("--seeds 1 --without-runs"), 0) << said; // the first of the plan's
    EXPECT_THAT(document(), HasSubstr("| First | 1 of 2 |"));
    EXPECT_EQ(validate("--seeds 3 --without-runs"), 2);
    EXPECT_THAT(said, HasSubstr("--seeds 3: the plan has 2 seeds"));
    std::ofstream(folder / "plan.toml") << "seeds = \"1-3\"\n" + plan;
    ASSERT_EQ(validate("--seeds 3-3"), 0) << said;
    EXPECT_FALSE(fs::exists(folder / "runs/tiny-1"));
    EXPECT_THAT(document(), AllOf(HasSubstr("4 of 4 runs"), HasSubstr("| First | 3 of 3 |")));
    std::istringstream lines(before);
    const std::string definitions(listric::measures_hash);
    for (std::string line; std::getline(lines, line);)
        if (const auto origin = line.find(definitions); origin != line.npos) {
            EXPECT_THAT(record(), HasSubstr(line.substr(0, origin + definitions.size())));
        }
    EXPECT_THAT(record(), HasSubstr("tiny,3,200,"));
}

TEST_F(ValidationTest, NothingIsMixedOrReplacedWithoutAWord) {
    ASSERT_EQ(validate("--seeds 2"), 0) << said;
    const std::string definitions(listric::measures_hash);
    const auto all = record();

    // Measures of other definitions may be read; nothing is added to them.
    keep_lines([](const std::string& line) { return !line.starts_with("tiny,2,"); });
    replace_in_record("," + definitions, ",0123456789abcdef");
    const std::string others = record();
    ASSERT_EQ(validate("--seeds 1"), 0) << said;
    EXPECT_EQ(validate("--seeds 2"), 2);
    EXPECT_THAT(said,
                AllOf(HasSubstr("plain-1 was measured by other definitions"),
                      HasSubstr("0123456789abcdef"), HasSubstr(definitions), HasSubstr("--mixed")));
    EXPECT_EQ(record(), others);
    ASSERT_EQ(validate("--seeds 2 --mixed"), 0) << said;
    EXPECT_THAT(document(), HasSubstr("**This record is mixed**"));
    ASSERT_EQ(validate("--seeds 2 --remeasure"), 0) << said;
    EXPECT_EQ(record(), all);
    EXPECT_THAT(document(), Not(HasSubstr("mixed")));

    // A run is not taken for another that has its name.
    const std::string hash =
        nlohmann::json::parse(contents(folder / "runs/tiny-2/summary.json"))["state_hash"];
    replace_in_record("tiny,2,100," + hash, "tiny,2,100,0123456789abcdef");
    EXPECT_EQ(validate("--seeds 2"), 2);
    EXPECT_THAT(said, AllOf(HasSubstr("tiny-2"), HasSubstr(hash), HasSubstr("--remeasure")));

    // Runs of other parameters are no part of the record, even where they are gone.
    fs::remove_all(folder / "runs");
    std::string faster = scene;
    faster.replace(faster.find("speed_m_per_s = 4.0"), 19, "speed_m_per_s = 5.0");
    std::ofstream(folder / "scenes/tiny.toml") << faster;
    EXPECT_EQ(validate("--seeds 3"), 2);
    EXPECT_THAT(said, HasSubstr("plain-1 was run with other parameters"));
    EXPECT_FALSE(fs::exists(folder / "runs/tiny-3"));
}

// A document names plan and accuracy, which its runs must have even where nothing is left to add.
TEST_F(ValidationTest, ARecordIsNotPublishedAsAnother) {
    ASSERT_EQ(validate("--seeds 1 --only second"), 0) << said;
    const std::string before = document();
    EXPECT_EQ(validate("--seeds 1 --only second --without-runs"), 0) << said;
    EXPECT_EQ(document(), before);
    fs::remove_all(folder / "runs");
    EXPECT_EQ(validate("--seeds 1 --only second --accuracy draft"), 2);
    EXPECT_THAT(said, HasSubstr("plain-1 was run with other parameters"));
    std::string other = plan;
    other.replace(other.find("seeds = 1\n"), 10, "seeds = 1\nset = \"detachment.friction=0.4\"\n");
    std::ofstream(folder / "plan.toml") << other;
    EXPECT_EQ(validate("--seeds 1 --only second --without-runs"), 2);
    EXPECT_THAT(said, AllOf(HasSubstr("plain-1 was run with other parameters"),
                            HasSubstr("at accuracy standard"), HasSubstr("--mixed")));
    EXPECT_EQ(document(), before);
    EXPECT_EQ(validate("--seeds 1 --only second --without-runs --mixed"), 0) << said;
    EXPECT_THAT(document(), HasSubstr("**This record is mixed**: other parameters than the plan's "
                                      "had plain-1."));
    // Another version may write the scene otherwise; its record is shown, and nothing added.
    const std::string maker = "," + std::string(listric::version) + ",";
    replace_in_record(maker, ",0.1.0+0123abcd,");
    EXPECT_EQ(validate("--seeds 1 --only second --without-runs"), 0) << said;
    EXPECT_THAT(document(), HasSubstr("1 of 1 runs"));
    EXPECT_THAT(document(), HasSubstr("written otherwise than the plan's: 1;"));
    EXPECT_EQ(validate("--seeds 1 --only first"), 2);
    EXPECT_THAT(said, HasSubstr("plain-1 was run with other parameters"));
}

TEST_F(ValidationTest, ARunThatFailsCostsNoOther) {
    std::string text = plan;
    text.replace(text.find("seeds = 1\n"), 10, "seeds = 1\nset = \"cycle.time_step_safety=8\"\n");
    std::ofstream(folder / "plan.toml") << text;
    for (int call = 0; call < 2; ++call) {
        EXPECT_EQ(validate("--seeds 1 --only first"), 3) << said;
        EXPECT_THAT(record(), HasSubstr("tiny,1,200,"));
        EXPECT_THAT(document(), AllOf(HasSubstr("1 of 2 runs"), HasSubstr("Runs that failed"),
                                      HasSubstr("\n- plain-1: "), HasSubstr("| met (1 of 1) |")));
    }
    EXPECT_THAT(contents(folder / "runs/plain-1/status.json"), HasSubstr(R"("phase": "failed")"));
}

TEST_F(ValidationTest, WritesWhereNobodyElseDoes) {
    fs::create_directories(folder / "doc/report");
    {
        const archive::FolderLock other(folder / "doc/report");
        EXPECT_EQ(validate("--seeds 1"), 2);
        EXPECT_THAT(said, HasSubstr("another run is writing there"));
    }
    std::ofstream(folder / "doc/report.md") << "# Notes\n";
    EXPECT_EQ(validate("--seeds 1"), 2);
    EXPECT_THAT(said, HasSubstr("report.md: is no file of such a call"));
    EXPECT_EQ(document(), "# Notes\n");
    EXPECT_FALSE(fs::exists(folder / "runs"));
}

// The cheapest row of the shipped plan: two runs at draft, one seed of five. Over five seeds the
// plate had 0.51 to 0.73 of its strain in the most strained tenth, the rubber 0.22 to 0.27.
TEST_F(ValidationTest, ShippedBenchmarksAreRunByName) {
    const std::string line = "'" + std::string(program_path) +
                             "' validate --plan benchmarks --only base --seeds 1 --runs " +
                             (folder / "runs").string() + " --output " +
                             (folder / "doc/report.md").string() + " -q";
    ASSERT_EQ(WEXITSTATUS(std::system(line.c_str())), 0);
    EXPECT_THAT(document(), AllOf(HasSubstr("2 of 2 runs"), HasSubstr("| met (1 of 1) |"),
                                  HasSubstr("![base](report/base.png)")));
}

TEST_F(ValidationTest, BadCalls) {
    EXPECT_EQ(validate("--only third"), 2);
    EXPECT_THAT(said, HasSubstr("first, second"));
    for (const char* bad : {"--seeds 0", "--seeds 1001", "--seeds 5-3", "--seeds some"}) {
        EXPECT_EQ(validate(bad), 2) << bad;
        EXPECT_THAT(said, HasSubstr("such as 51-56,60"));
    }
    EXPECT_EQ(validate("--seeds 5-6 --first-seed 5"), 2);
    EXPECT_EQ(validate("--accuracy rough"), 2);
    EXPECT_THAT(said, HasSubstr("draft, standard"));
    std::ofstream(folder / "plan.toml") << "[[run]]\nname = 3\n";
    EXPECT_EQ(validate(""), 2);
    EXPECT_THAT(said, AllOf(HasSubstr("plan.toml:2"), HasSubstr("name")));
    EXPECT_FALSE(fs::exists(folder / "runs"));
}

} // namespace
} // namespace listric::validation_test
